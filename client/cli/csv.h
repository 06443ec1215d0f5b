// Setpoints as comma-separated values.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "client/sdk/setpoint_stream.h"

namespace kcs::cli {

// "t,x,y,z\n", and for each channel asked for its columns: vx,vy,vz, ax,ay,az, jx,jy,jz, path_position, segment.
// Machines with two axes have no z. Always in that order.
std::string csv_header(std::size_t axes, const std::vector<client::Channel>& channels);

// One row a setpoint: its time (index × period, s), then the columns of the header (mm, mm/s, mm/s², mm/s³, mm), with
// 15 significant digits.
std::string csv_rows(const client::SetpointBatch& batch, double period_s);

// Writes header and rows of the whole stream; calls `progress` after each batch. Throws client::FileError if `out`
// cannot be written.
void write_csv(client::SetpointStream& stream, std::size_t axes, const client::StreamOptions& options,
               std::ostream& out, const std::function<void(const client::SetpointBatch&)>& progress);

}  // namespace kcs::cli
