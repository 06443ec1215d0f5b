#include "server/service/observe_settings.h"

#include <stdexcept>

namespace kcs::service {

Keys observe_keys(ObserveSettings& settings) {
  return {
      {"http_listen", text(settings.http_listen)},
      {"channelz", flag(settings.channelz)},
      {"log_format", parsed([&settings](const std::string& name) { settings.log_format = parse_log_format(name); })}};
}

observe::LogFormat parse_log_format(const std::string& name) {
  if (name == "text") return observe::LogFormat::kText;
  if (name == "json") return observe::LogFormat::kJson;
  throw std::runtime_error("\"" + name + "\" is no log format: use text or json");
}

}  // namespace kcs::service
