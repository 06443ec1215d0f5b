// The paper's X-Y table, simulated: the machine that the gateway drives when there is no real one.
#pragma once

#include <cstddef>
#include <vector>

#include "client/gateway/simulated_drive.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

// The drives of the table, in the order X, Y, Z.
//
// The paper says what it measured with: a heavy gantry (X) that carries a lighter slide (Y), linear motors (two of the
// three in the gantry), encoders of 0.7125 µm, position loops matched at 35 Hz. It does not print masses and friction;
// those here are usual for such a table:
//   - masses of 40 kg and 12 kg; motors with peak forces of 500 N each;
//   - four guideway carriages an axis whose wipers drag with 10 N (gantry) and 5 N (slide) each, and 10 N for every
//   motor
//     from the pull of its magnets (3 kN at a rolling friction of 0.3 %): 60 N and 30 N of dry friction; a third more
//     to break loose, gone at a few mm/s; 0.1 and 0.05 N per mm/s of viscous friction.
// Z, which the paper's table does not have, is a counterbalanced slide like Y.
std::vector<DriveParameters> table_drives();

// The drives of all axes, moved together.
class SimulatedTable {
 public:
  // At rest at `start_mm`. axes: 2 or 3, of which the entries are read.
  SimulatedTable(std::size_t axes, const Vector& start_mm);

  // Hands every drive its commanded position for the coming period and lets the period pass.
  // Returns what the encoders read at its end, mm. Does not allocate.
  Vector follow(const Vector& commanded_mm, double period_s);

 private:
  std::vector<SimulatedDrive> drives_;
};

}  // namespace kcs::gateway
