#include "client/gateway/machine/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "client/gateway/machine/staging.h"
#include "client/sdk/machine_profile.h"
#include "client/sdk/toml_reader.h"

namespace kcs::gateway {
namespace {

constexpr double kShortestPeriod = 1e-4;  // s
constexpr double kLongestPeriod = 0.1;    // s
constexpr double kMostDrift = 500;        // ppm: crystals keep to a tenth of that
// The player needs one slot free to be given the next batch, and what it plays it has copied.
constexpr int kBatchesAhead = KCS_PLAYER_SLOTS - 1;

class Reader {
 public:
  Reader(std::string_view text, const std::string& source) : reader_(source), root_(reader_.parse(text)) {}

  Settings read() {
    reader_.refuse_unknown(root_, "", {"machine", "server", "stream", "simulated", "hal"});
    read_machine(reader_.section(root_, "machine"));
    if (root_.contains("server")) read_server(reader_.section(root_, "server"));
    if (root_.contains("stream")) read_stream(reader_.section(root_, "stream"));
    if (settings_.driver == Driver::kSimulated) {
      read_simulated(reader_.section(root_, "simulated"));
    } else {
      read_hal(reader_.section(root_, "hal"));
    }
    return std::move(settings_);
  }

 private:
  // Hands the value of a key, if it is there, to `take`.
  template <typename Take>
  void with(const toml::table& table, const std::string& section, std::string_view key, Take take) {
    if (const toml::node* node = table.get(key)) take(*node, fmt::format("{}.{}", section, key));
  }

  void read_machine(const toml::table& table) {
    reader_.refuse_unknown(table, "machine.", {"name", "driver"});
    const toml::node* name = table.get("name");
    if (name == nullptr) reader_.fail(table, "machine.name", "is missing; say what the server is to call this machine");
    settings_.machine = "machines/" + machine_name(*name);
    with(table, "machine", "driver", [this](const toml::node& node, const std::string& key) {
      const std::string driver = reader_.text(node, key);
      if (driver != "simulated" && driver != "hal") reader_.fail(node, key, "must be \"simulated\" or \"hal\"");
      settings_.driver = driver == "hal" ? Driver::kHal : Driver::kSimulated;
    });
  }

  std::string machine_name(const toml::node& node) const {
    const std::string name = reader_.text(node, "machine.name");
    const bool fits = !name.empty() && name.size() <= 63 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
    if (!fits) reader_.fail(node, "machine.name", "must be 1 to 63 letters, digits, \"-\" and \"_\"");
    return name;
  }

  void read_server(const toml::table& table) {
    reader_.refuse_unknown(table, "server.", {"address", "tls", "tls_ca", "tls_cert", "tls_key", "token_file"});
    client::Connection& server = settings_.server;
    const auto text = [&](std::string_view name, auto& target) {
      with(table, "server", name,
           [&](const toml::node& node, const std::string& key) { target = reader_.text(node, key); });
    };
    text("address", server.address);
    text("tls_ca", server.ca_file);
    text("tls_cert", server.certificate_file);
    text("tls_key", server.key_file);
    text("token_file", server.token_file);
    with(table, "server", "tls",
         [&](const toml::node& node, const std::string& key) { server.tls = reader_.flag(node, key); });
    // Whoever names a certificate wants TLS.
    server.tls = server.tls || !server.ca_file.empty() || !server.certificate_file.empty();
  }

  void read_stream(const toml::table& table) {
    reader_.refuse_unknown(table, "stream.", {"batch_s", "window_s", "commit_s", "report_s"});
    StreamSettings& stream = settings_.stream;
    const auto seconds = [&](std::string_view name, double& target, double low, double high) {
      with(table, "stream", name,
           [&](const toml::node& node, const std::string& key) { target = reader_.number(node, key, low, high); });
    };
    seconds("batch_s", stream.batch_s, 0.001, 0.1);
    seconds("window_s", stream.window_s, 0.05, 10);
    seconds("commit_s", stream.commit_s, 0.002, 0.7);
    seconds("report_s", stream.report_s, 0.005, 1);
    if (stream.commit_s > kBatchesAhead * stream.batch_s) {
      reader_.fail(
          table, "stream.commit_s",
          fmt::format("is more than the player has room for: make it {} batches (batch_s) at most", kBatchesAhead));
    }
    if (stream.window_s > static_cast<double>(Staging::kMostBatches) * stream.batch_s) {
      reader_.fail(table, "stream.window_s",
                   fmt::format("is too long: make it {} batches (batch_s) at most", Staging::kMostBatches));
    }
    if (stream.window_s < stream.commit_s + 2 * stream.batch_s) {
      reader_.fail(table, "stream.window_s", "is too short: it must hold commit_s and two batches (batch_s) more");
    }
  }

  void read_simulated(const toml::table& table) {
    reader_.refuse_unknown(table, "simulated.",
                           {"profile", "period_s", "following_error_mm", "start_mm", "clock_drift_ppm", "switches"});
    std::string profile = "router";
    with(table, "simulated", "profile",
         [&](const toml::node& node, const std::string& key) { profile = reader_.text(node, key); });
    const client::Machine machine = client::find_machine(profile);
    std::vector<double> following_error(machine.axes, 1.0);
    settings_.simulated.start_mm.assign(machine.axes, 0.0);
    double period = 0.001;
    with(table, "simulated", "period_s", [&](const toml::node& node, const std::string& key) {
      period = reader_.number(node, key, kShortestPeriod, kLongestPeriod);
    });
    with(table, "simulated", "following_error_mm", [&](const toml::node& node, const std::string& key) {
      following_error = reader_.positive_per_axis(node, key, machine.axes);
    });
    with(table, "simulated", "start_mm", [&](const toml::node& node, const std::string& key) {
      settings_.simulated.start_mm = reader_.per_axis(node, key, machine.axes);
    });
    with(table, "simulated", "clock_drift_ppm", [&](const toml::node& node, const std::string& key) {
      settings_.simulated.clock_drift_ppm = reader_.number(node, key, -kMostDrift, kMostDrift);
    });
    with(table, "simulated", "switches", [&](const toml::node& node, const std::string& key) {
      settings_.simulated.switches = reader_.text(node, key);
    });
    settings_.simulated.profile = player_profile(machine, period, following_error);
  }

  static kcs_player_profile player_profile(const client::Machine& machine, double period,
                                           const std::vector<double>& following_error) {
    kcs_player_profile profile{.axes = static_cast<std::uint32_t>(machine.axes), .period_s = period};
    for (std::size_t axis = 0; axis < machine.axes; ++axis) {
      profile.velocity_mm_s[axis] = machine.velocity_mm_s[axis];
      profile.acceleration_mm_s2[axis] = machine.acceleration_mm_s2[axis];
      profile.jerk_mm_s3[axis] = machine.jerk_mm_s3[axis];
      profile.following_error_mm[axis] = following_error[axis];
    }
    return profile;
  }

  void read_hal(const toml::table& table) {
    reader_.refuse_unknown(table, "hal.", {"component"});
    settings_.hal_component = "player";
    with(table, "hal", "component", [this](const toml::node& node, const std::string& key) {
      settings_.hal_component = reader_.text(node, key);
      const bool fits = !settings_.hal_component.empty() && settings_.hal_component.find('/') == std::string::npos;
      if (!fits) reader_.fail(node, key, "must be the name that the component was loaded with");
    });
  }

  client::TomlReader reader_;
  toml::table root_;
  Settings settings_;
};

}  // namespace

Settings parse_settings(std::string_view text, const std::string& source) { return Reader(text, source).read(); }

Settings read_settings(const std::filesystem::path& file) {
  return parse_settings(client::read_settings_text(file, "; deploy/gateway.toml is an example"), file.string());
}

}  // namespace kcs::gateway
