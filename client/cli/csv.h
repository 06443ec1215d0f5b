// Setpoints as text: comma-separated values, and what LinuxCNC's halstreamer reads.
#pragma once

#include <iosfwd>
#include <string>

#include "client/cli/setpoint_writer.h"

namespace kcs::cli {

// The names of the columns: "t,x,y,z\n".
std::string csv_header(const SetpointColumns& columns);

// One row a setpoint: its time (index × period, s), then the columns of the header (mm, mm/s, mm/s², mm/s³, mm), with
// 15 significant digits.
std::string csv_rows(const client::SetpointBatch& batch, double period_s);

// The same without the time and with blanks for commas: halstreamer's clock is the thread that its component runs in.
std::string streamer_rows(const client::SetpointBatch& batch);

class CsvWriter final : public SetpointWriter {
 public:
  // Writes the header.
  CsvWriter(const SetpointColumns& columns, std::ostream& out);
  void add(const client::SetpointBatch& batch) override;
  void finish() override {}

 private:
  double period_s_;
  std::ostream& out_;
};

class StreamerWriter final : public SetpointWriter {
 public:
  explicit StreamerWriter(std::ostream& out) : out_(out) {}
  void add(const client::SetpointBatch& batch) override;
  void finish() override {}

 private:
  std::ostream& out_;
};

}  // namespace kcs::cli
