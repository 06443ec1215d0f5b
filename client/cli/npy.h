// Setpoints as a NumPy array.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "client/cli/setpoint_writer.h"

namespace kcs::cli {

// A file of NumPy's format 1.0: an array with one record a setpoint, whose fields are called like the columns.
//   setpoints = numpy.load("setpoints.npy"); setpoints["x"]
// All fields are doubles but `segment`, an unsigned integer of 64 bits. The file must be one that can be sought in: how
// many setpoints there are is written into its head when the last one has come.
class NpyWriter final : public SetpointWriter {
 public:
  NpyWriter(const SetpointColumns& columns, std::ostream& out);

  void add(const client::SetpointBatch& batch) override;
  void finish() override;

 private:
  void write_header();

  SetpointColumns columns_;
  std::ostream& out_;
  std::uint64_t setpoints_ = 0;
};

}  // namespace kcs::cli
