// The tables of the store, and their versions.
//
//   plans         one row a plan: what it is searched by, its outcome, and who plans it
//   owners        one row for each owner of each plan
//   request_rows  the requests, compressed, in pieces of bounded size, see request_rows.h
//   runs          one row a run; of those that are not over, one a machine at most
//   machines      one row a machine that ever had a run: how many it had
//   kcs_schema    one row: the version, and the oldest version whose servers can use the tables as they are
//
// Times are in µs since 1970, by the database's clock where it has one, so that servers agree.
#pragma once

#include <string>
#include <vector>

#include "server/store/connections.h"

namespace kcs::store {

// Makes what is missing and brings an older schema up to date; several servers may do it at the same moment. A newer
// one is left as it is. Throws StoreError if servers of this version cannot use that.
void prepare_schema(Connections& connections);

struct SchemaChange {
  int from = 0;                   // version
  std::vector<std::string> lost;  // by going back
};

// See change_schema(). `connections` has one connection.
SchemaChange move_schema(Connections& connections, int version);

}  // namespace kcs::store
