#include "server/store/listing.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "server/store/page_token.h"
#include "server/store/plan_rows.h"

namespace kcs::store {
namespace {

// What the rows of a page must meet, as SQL and its parameters.
class Conditions {
 public:
  Conditions(const Whose& whose, const Filter& filter, const std::optional<PageEnd>& after) {
    add(condition_of(whose));
    if (whose) texts_.emplace_back("owner", *whose);
    if (filter.machine_name) require("p.machine_name = :machine_name", "machine_name", *filter.machine_name);
    if (filter.state) require("p.state = :state", "state", static_cast<long long>(*filter.state));
    if (filter.created_from) require("o.create_time >= :created_from", "created_from", count(*filter.created_from));
    if (filter.created_before) {
      require("o.create_time < :created_before", "created_before", count(*filter.created_before));
    }
    if (filter.cycle_time_at_least) require("p.cycle_time >= :at_least", "at_least", *filter.cycle_time_at_least);
    if (filter.cycle_time_at_most) require("p.cycle_time <= :at_most", "at_most", *filter.cycle_time_at_most);
    if (after) {
      require("(o.create_time, o.name) < (:after_time, :after_name)", "after_time", count(after->create_time));
      texts_.emplace_back("after_name", after->name);
    }
  }

  const std::string& sql() const { return sql_; }

  // The statement must not outlive this.
  void bind(soci::statement& statement) const {
    for (const auto& [parameter, value] : texts_) statement.exchange(soci::use(value, parameter));
    for (const auto& [parameter, value] : counts_) statement.exchange(soci::use(value, parameter));
    for (const auto& [parameter, value] : numbers_) statement.exchange(soci::use(value, parameter));
  }

 private:
  template <typename Value>
  using Parameters = std::vector<std::pair<std::string, Value>>;

  static long long count(Time time) { return time.time_since_epoch().count(); }

  void require(std::string_view condition, const char* parameter, const std::string& value) {
    add(condition);
    texts_.emplace_back(parameter, value);
  }
  void require(std::string_view condition, const char* parameter, long long value) {
    add(condition);
    counts_.emplace_back(parameter, value);
  }
  void require(std::string_view condition, const char* parameter, double value) {
    add(condition);
    numbers_.emplace_back(parameter, value);
  }

  void add(std::string_view condition) {
    sql_ += sql_.empty() ? "" : " and ";
    sql_ += condition;
  }

  std::string sql_;
  Parameters<std::string> texts_;
  Parameters<long long> counts_;
  Parameters<double> numbers_;
};

}  // namespace

Page list_plans(Connections& connections, const std::string& planner, const Whose& whose, const Filter& filter,
                std::size_t page_size, const std::string& page_token) {
  std::optional<PageEnd> after;
  if (!page_token.empty()) after = parse_page_token(page_token, whose, filter);
  const Conditions conditions(whose, filter, after);
  const Dialect& dialect = connections.dialect();
  Page page;
  page.records = connections.read([&](soci::session& session) {
    RecordRow row;
    const auto limit = static_cast<long long>(page_size) + 1;  // one more tells whether there is another page
    soci::statement statement(session);
    statement.exchange(soci::use(planner, "planner"));
    conditions.bind(statement);
    statement.exchange(soci::use(limit, "limit"));
    row.receive(statement);
    run(statement, fmt::format("select {} from {} where {} order by o.create_time desc, o.name desc limit :limit",
                               record_columns(dialect), record_tables(whose), conditions.sql()));
    std::vector<Record> records;
    while (statement.fetch()) records.push_back(row.record(dialect));
    return records;
  });
  if (page.records.size() > page_size) {
    page.records.resize(page_size);
    const Record& last = page.records.back();
    page.next_page_token = kcs::store::page_token({.create_time = last.create_time, .name = last.name}, whose, filter);
  }
  return page;
}

}  // namespace kcs::store
