#include "client/cli/npy.h"

#include <fmt/format.h>

#include <bit>
#include <ostream>
#include <string_view>

#include "client/common/file_error.h"

namespace kcs::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes are written as they are in memory");

// Of the whole head: a multiple of 64, with room for every column there is and any number of setpoints.
constexpr std::size_t kHeadBytes = 512;
constexpr std::size_t kPrefixBytes = 10;  // magic, version, length of the rest

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

// As add() writes it.
std::string_view type_of(std::string_view column) {
  if (column == "segment") return "<u8";
  return column == "line" ? "<u4" : "<f8";
}

void require_written(const std::ostream& out) {
  if (!out) {
    throw client::FileError("the setpoints cannot be written; is the disk full?");
  }
}

}  // namespace

NpyWriter::NpyWriter(const SetpointColumns& columns, std::ostream& out) : columns_(columns), out_(out) {
  if (out_.tellp() == std::ostream::pos_type(-1)) {
    throw client::FileError(
        "NumPy's format needs an ordinary file: give its name with --output, or choose --format csv");
  }
  write_header();
}

void NpyWriter::add(const client::SetpointBatch& batch) {
  std::string bytes;
  for (std::size_t row = 0; row < batch.size(); ++row) {
    append(bytes, static_cast<double>(batch.first_index + row) * columns_.period_s);
    for (const client::Columns* columns :
         {&batch.position_mm, &batch.velocity_mm_s, &batch.acceleration_mm_s2, &batch.jerk_mm_s3}) {
      for (const std::vector<double>& column : *columns) append(bytes, column[row]);
    }
    if (!batch.path_position_mm.empty()) append(bytes, batch.path_position_mm[row]);
    if (!batch.segment.empty()) append(bytes, batch.segment[row]);
    if (!batch.line.empty()) append(bytes, batch.line[row]);
  }
  setpoints_ += batch.size();
  require_written(out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())));
}

void NpyWriter::finish() {
  require_written(out_.seekp(0));
  write_header();
  require_written(out_.flush());
}

void NpyWriter::write_header() {
  std::string fields;
  for (const std::string& name : columns_.names()) {
    fields += fmt::format("('{}', '{}'), ", name, type_of(name));
  }
  const std::string text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, setpoints_);
  std::string head = std::string("\x93NUMPY\x01\x00", 8);
  append(head, static_cast<std::uint16_t>(kHeadBytes - kPrefixBytes));
  head += text;
  head.resize(kHeadBytes - 1, ' ');
  require_written(out_ << head << '\n');
}

}  // namespace kcs::cli
