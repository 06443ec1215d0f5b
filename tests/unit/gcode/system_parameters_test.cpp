// What a program learns about the machine, checked against the blocks before.
#include "server/gcode/system_parameters.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/gcode/machine.h"
#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

TEST(SystemParameters, TellWhereTheToolIsInTheProgramsUnit) {
  Machine machine;
  machine.run("G20 G0 X1 Y2 Z-3");
  EXPECT_DOUBLE_EQ(machine.value_of("#5420"), 1);
  EXPECT_DOUBLE_EQ(machine.value_of("#<_y>"), 2);
  EXPECT_DOUBLE_EQ(machine.value_of("#5422"), -3);
  machine.run("G21");
  EXPECT_DOUBLE_EQ(machine.value_of("#<_x>"), 25.4);
  EXPECT_DOUBLE_EQ(machine.value_of("#5421"), 50.8);
  EXPECT_DOUBLE_EQ(machine.value_of("#<_z>"), -76.2);
}

TEST(SystemParameters, TellWhereTheToolIsInTheProgramsCoordinates) {
  Machine machine;
  machine.run("G0 X10 Y20");
  machine.run("G92 X1");
  EXPECT_EQ(machine.value_of("#<_x>"), 1);
  EXPECT_EQ(machine.value_of("#<_y>"), 20);
  machine.run("G92.1");
  EXPECT_EQ(machine.value_of("#5420"), 10);
}

TEST(SystemParameters, TellWhereTheToolIsBeforeTheBlockThatAsks) {
  const Program program = read_program("G0 X1\nX[#<_x>+1] Y#<_x>");
  EXPECT_EQ(program.end().x(), 2);
  EXPECT_EQ(program.end().y(), 1);
}

TEST(SystemParameters, TellWhatIsInForceAtTheStart) {
  const Machine machine;
  EXPECT_EQ(machine.value_of("#<_motion_mode>"), 800);
  EXPECT_EQ(machine.value_of("#<_plane>"), 170);
  EXPECT_EQ(machine.value_of("#<_metric>"), 1);
  EXPECT_EQ(machine.value_of("#<_imperial>"), 0);
  EXPECT_EQ(machine.value_of("#<_absolute>"), 1);
  EXPECT_EQ(machine.value_of("#<_incremental>"), 0);
  EXPECT_EQ(machine.value_of("#<_ijk_absolute_mode>"), 0);
  EXPECT_EQ(machine.value_of("#<_inverse_time>"), 0);
  EXPECT_EQ(machine.value_of("#<_units_per_minute>"), 1);
  EXPECT_EQ(machine.value_of("#<_units_per_rev>"), 0);
  EXPECT_EQ(machine.value_of("#<_lathe_diameter_mode>"), 0);
  EXPECT_EQ(machine.value_of("#<_lathe_radius_mode>"), 1);
  EXPECT_EQ(machine.value_of("#<_coord_system>"), 540);
  EXPECT_EQ(machine.value_of("#5220"), 1);
}

TEST(SystemParameters, TellWhatABlockPutIntoForce) {
  Machine machine;
  machine.run("G18 G20 G91 G90.1 G93");
  EXPECT_EQ(machine.value_of("#<_plane>"), 180);
  EXPECT_EQ(machine.value_of("#<_metric>"), 0);
  EXPECT_EQ(machine.value_of("#<_imperial>"), 1);
  EXPECT_EQ(machine.value_of("#<_absolute>"), 0);
  EXPECT_EQ(machine.value_of("#<_incremental>"), 1);
  EXPECT_EQ(machine.value_of("#<_ijk_absolute_mode>"), 1);
  EXPECT_EQ(machine.value_of("#<_inverse_time>"), 1);
  EXPECT_EQ(machine.value_of("#<_units_per_minute>"), 0);
  machine.run("G19");
  EXPECT_EQ(machine.value_of("#<_plane>"), 190);
}

TEST(SystemParameters, TellTheMotion) {
  Machine machine;
  for (const int number : {0, 1, 2, 3, 80}) {
    machine.run("G" + std::to_string(number));
    EXPECT_EQ(machine.value_of("#<_motion_mode>"), 10 * number);
  }
}

TEST(SystemParameters, TellTheCoordinateSystem) {
  Machine machine;
  int number = 1;
  for (const char* word : {"G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"}) {
    machine.run(word);
    EXPECT_EQ(machine.value_of("#5220"), number++);
    EXPECT_EQ(machine.value_of("#<_coord_system>"), 10 * std::stod(word + 1));
  }
}

TEST(SystemParameters, TellThatOffsetsAreZero) {
  const Machine machine;
  for (const char* offset : {"#5221", "#5390", "#5401", "#5409", "#<_tool_offset>"}) {
    EXPECT_EQ(machine.value_of(offset), 0) << offset;
  }
}

TEST(SystemParameters, TellTheLine) { EXPECT_EQ(read_program("(first)\n\nG0 X#<_line>").end().x(), 3); }

TEST(SystemParameters, AreRefusedByNameWhereKcsDoesNotKnow) {
  for (const std::string name :
       {"#5061", "#5070", "#5161", "#5210", "#5400", "#5410", "#5423", "#5599", "#5602", "#<_feed>", "#<_a>", "#<_rpm>",
        "#<_current_tool>", "#<_vminor>", "#<_ini[axis_x]max_velocity>", "#<_hal[motion.probe-input]>"}) {
    const std::string refusal = refusal_of("G0\nX" + name);
    EXPECT_TRUE(refusal.starts_with("gcode, line 2, column 2: " + name + " asks for something about the machine"))
        << refusal;
    EXPECT_NE(refusal_of("X EXISTS[" + name + "]"), "") << name;
  }
}

TEST(SystemParameters, CannotBeSet) {
  for (const std::string name : {"#5061", "#5220", "#5221", "#5420", "#5602", "#<_x>", "#<_metric>", "#<_rpm>"}) {
    EXPECT_TRUE(refusal_of("G21 " + name + "=1").starts_with("gcode, line 1, column 5: " + name + " is the machine's"))
        << name;
  }
}

TEST(SystemParameters, LeaveAllOtherNamesToThePrograms) {
  Machine machine;
  machine.run("#<_depth>=1 #<x>=2 #<line>=3 #<_xx>=4");
  EXPECT_EQ(machine.value_of("#<_depth>"), 1);
  EXPECT_EQ(machine.value_of("#<x>"), 2);
  EXPECT_EQ(machine.value_of("#<line>"), 3);
  EXPECT_EQ(machine.value_of("#<_xx>"), 4);
}

}  // namespace
}  // namespace kcs::gcode
