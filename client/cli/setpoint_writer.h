// Setpoints written to a file, in one of several formats.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "client/sdk/setpoint_stream.h"

namespace kcs::cli {

enum class SetpointFormat {
  kCsv,       // csv.h
  kNumPy,     // npy.h
  kStreamer,  // text for LinuxCNC's halstreamer: a line a setpoint, its columns without the time, blanks between them
};

// The format that the name of a file asks for by its end: .npy, .hal, or whatever else for CSV.
SetpointFormat format_of(const std::string& file);

// What the setpoints consist of.
struct SetpointColumns {
  std::size_t axes = 0;
  std::vector<client::Channel> channels;
  double period_s = 0;

  // "t", "x", "y", "z", and for each channel asked for its columns: vx… (mm/s), ax… (mm/s²), jx… (mm/s³),
  // path_position (mm), segment, line (whole numbers). Always in that order.
  std::vector<std::string> names() const;
};

// Gets the setpoints of one stream, in order. Writes to a stream that outlives it.
class SetpointWriter {
 public:
  virtual ~SetpointWriter() = default;
  // Throws client::FileError if it cannot be written.
  virtual void add(const client::SetpointBatch& batch) = 0;
  // After the last batch.
  virtual void finish() = 0;
};

std::unique_ptr<SetpointWriter> make_writer(SetpointFormat format, const SetpointColumns& columns, std::ostream& out);

}  // namespace kcs::cli
