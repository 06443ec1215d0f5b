#include "server/store/schema_command.h"

#include <fmt/format.h>

#include <ostream>

#include "server/store/connections.h"
#include "server/store/schema.h"

namespace kcs::store {

void change_schema(const StoreSettings& settings, int version, std::ostream& out) {
  StoreSettings alone = settings;
  alone.connections = 1;  // others would look like those of another kcsd
  Connections connections(alone);
  const SchemaChange change = move_schema(connections, version);
  out << fmt::format("the store's database ({}): its tables were of version {} and are of version {}\n",
                     connections.dialect().description(), change.from, version);
  for (const std::string& lost : change.lost) out << "lost: " << lost << '\n';
}

}  // namespace kcs::store
