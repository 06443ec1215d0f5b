#include "client/cli/csv.h"

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <vector>

#include "client/common/file_error.h"

namespace kcs::cli {
namespace {

void append_columns(std::string& text, const client::SetpointBatch& batch, std::size_t row, char separator) {
  for (const client::Columns* columns :
       {&batch.position_mm, &batch.velocity_mm_s, &batch.acceleration_mm_s2, &batch.jerk_mm_s3}) {
    for (const std::vector<double>& column : *columns) {
      fmt::format_to(std::back_inserter(text), "{:.15g}{}", column[row], separator);
    }
  }
  if (!batch.path_position_mm.empty()) {
    fmt::format_to(std::back_inserter(text), "{:.15g}{}", batch.path_position_mm[row], separator);
  }
  if (!batch.segment.empty()) fmt::format_to(std::back_inserter(text), "{}{}", batch.segment[row], separator);
  if (!batch.line.empty()) fmt::format_to(std::back_inserter(text), "{}{}", batch.line[row], separator);
  text.back() = '\n';
}

// At once, for whoever reads a live stream.
void write(std::ostream& out, const std::string& rows) {
  if (!(out << rows << std::flush)) throw client::FileError("the setpoints cannot be written; is the disk full?");
}

}  // namespace

std::string csv_header(const SetpointColumns& columns) { return fmt::format("{}\n", fmt::join(columns.names(), ",")); }

std::string csv_rows(const client::SetpointBatch& batch, double period_s) {
  std::string rows;
  for (std::size_t row = 0; row < batch.size(); ++row) {
    fmt::format_to(std::back_inserter(rows), "{:.15g},", static_cast<double>(batch.first_index + row) * period_s);
    append_columns(rows, batch, row, ',');
  }
  return rows;
}

std::string streamer_rows(const client::SetpointBatch& batch) {
  std::string rows;
  for (std::size_t row = 0; row < batch.size(); ++row) append_columns(rows, batch, row, ' ');
  return rows;
}

CsvWriter::CsvWriter(const SetpointColumns& columns, std::ostream& out) : period_s_(columns.period_s), out_(out) {
  write(out_, csv_header(columns));
}

void CsvWriter::add(const client::SetpointBatch& batch) { write(out_, csv_rows(batch, period_s_)); }

void StreamerWriter::add(const client::SetpointBatch& batch) { write(out_, streamer_rows(batch)); }

}  // namespace kcs::cli
