// Lists plans, page by page.
#pragma once

#include <cstddef>
#include <string>

#include "server/store/connections.h"
#include "server/store/records.h"

namespace kcs::store {

// See Store::list(). `planner`: the server that asks.
Page list_plans(Connections& connections, const std::string& planner, const Whose& whose, const Filter& filter,
                std::size_t page_size, const std::string& page_token);

}  // namespace kcs::store
