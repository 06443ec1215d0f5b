// The program kcsctl: what it prints and writes, and how it fails, with the service inside and with a real kcsd.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

// Two legs of 10 mm with a right angle between them, and a quarter of a circle.
constexpr const char* kProgram = "G21 G90 G64\nG1 X10 Y0 F6000\nG1 X10 Y10\nG2 X20 Y20 I10 J0\n";

class Kcsctl : public testing::Test {
 protected:
  Kcsctl() { folder_.write("part.ngc", kProgram); }

  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string program() const { return path("part.ngc"); }

  static Result run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), KCSCTL);
    return kcs::test::run(arguments);
  }

  static std::string read(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  const TemporaryFolder folder_;
};

std::vector<std::vector<double>> parse_rows(std::istringstream& csv) {
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(csv, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

TEST_F(Kcsctl, PlanPrintsOneJsonObject) {
  const Result result = run({"plan", "--json", program()});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  const json plan = json::parse(result.output);
  EXPECT_GT(plan["cycle_time_s"], 0.3);
  EXPECT_NEAR(plan["path_length_mm"], 20 + 5 * M_PI, 0.01);
  EXPECT_LE(plan["max_contour_error_mm"], 0.01);
  EXPECT_GT(plan["time_at_feed_s"], -1e-12);
  EXPECT_LE(plan["max_feed_mm_s"], 100 * (1 + 1e-9));
  EXPECT_GE(plan["corner_count"], 1);
  for (const char* key : {"max_velocity_mm_s", "max_acceleration_mm_s2", "max_jerk_mm_s3"}) {
    EXPECT_EQ(plan[key].size(), 3) << key;
  }
}

TEST_F(Kcsctl, PlanPrintsATable) {
  const Result result = run({"plan", program()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("Cycle time"), std::string::npos) << result.output;
}

TEST_F(Kcsctl, StrategyAskedForIsTheOneThatIsTaken) {
  const Result result = run({"plan", program(), "--strategy", "blended"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("\n  blended "), std::string::npos) << result.output;
  const json corners = json::parse(run({"corners", "--json", program(), "--strategy", "blended"}).output);
  EXPECT_EQ(corners[0]["strategy"], "blended");
}

TEST_F(Kcsctl, CornersPrintsOneObjectForEachCorner) {
  const json plan = json::parse(run({"plan", "--json", program()}).output);
  const json corners = json::parse(run({"corners", "--json", program()}).output);
  EXPECT_EQ(corners.size(), plan["corner_count"]);
  EXPECT_EQ(corners[0]["segment"], 0);
  EXPECT_EQ(corners[0]["line"], 2);
  EXPECT_NEAR(corners[0]["angle_deg"], 90, 1e-9);
}

TEST_F(Kcsctl, StreamWritesEvenlySpacedRowsUpToTheExactEnd) {
  const Result result = run({"stream", program(), "-o", path("out.csv"), "--period", "0.002"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "") << "no progress bar where there is no terminal";
  std::istringstream csv(read(path("out.csv")));
  std::string header;
  std::getline(csv, header);
  EXPECT_EQ(header, "t,x,y,z");
  const auto rows = parse_rows(csv);
  const double cycle_time = json::parse(run({"plan", "--json", program()}).output)["cycle_time_s"];
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(std::ceil(cycle_time / 0.002)) + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_NEAR(rows[i][0], static_cast<double>(i) * 0.002, 1e-12);
  EXPECT_EQ(rows.front(), (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(rows.back()[1], 20);
  EXPECT_EQ(rows.back()[2], 20);
  EXPECT_EQ(files(), 2) << "the program and the setpoints, nothing else";
}

TEST_F(Kcsctl, StreamWritesTheChannelsAskedFor) {
  const Result result = run({"stream", program(), "-o", "-", "--channels", "velocity,acceleration,jerk"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output.substr(0, result.output.find('\n')), "t,x,y,z,vx,vy,vz,ax,ay,az,jx,jy,jz");
}

TEST_F(Kcsctl, StreamWritesWhatNumPyReads) {
  if (kcs::test::run({"/usr/bin/python3", "-c", "import numpy"}).exit_code != 0) GTEST_SKIP() << "there is no NumPy";
  for (const char* command : {"stream", "live"}) {
    ASSERT_EQ(run({command, program(), "-o", path("out.npy"), "--channels", "velocity,segment,line"}).exit_code, 0);
    ASSERT_EQ(run({command, program(), "-o", path("out.csv"), "--channels", "velocity,segment,line"}).exit_code, 0);
    const Result compared = kcs::test::run(
        {"/usr/bin/python3", "-c",
         "import numpy, sys\n"
         "npy = numpy.load(sys.argv[1])\n"
         "csv = numpy.genfromtxt(sys.argv[2], delimiter=',', names=True)\n"
         "assert npy.dtype.names == csv.dtype.names, npy.dtype\n"
         "assert npy['segment'].dtype == numpy.uint64\n"
         "assert npy['line'].dtype == numpy.uint32 and npy['line'][-1] > npy['line'][0] > 0, npy['line']\n"
         "for name in npy.dtype.names: numpy.testing.assert_allclose(npy[name], csv[name], rtol=1e-14, atol=1e-300)\n"
         "print(len(npy))\n",
         path("out.npy"), path("out.csv")});
    EXPECT_EQ(compared.exit_code, 0) << command << compared.errors;
    EXPECT_GT(std::stoi("0" + compared.output), 100);
  }
}

TEST_F(Kcsctl, NumPysFormatIsForFilesAlone) {
  const Result result = run({"stream", program(), "-o", "-", "--format", "npy"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.errors.find("ordinary file"), std::string::npos) << result.errors;
}

TEST_F(Kcsctl, StreamWritesWhatHalstreamerReads) {
  ASSERT_EQ(run({"stream", program(), "-o", path("out.hal")}).exit_code, 0);
  std::istringstream lines(read(path("out.hal")));
  std::string first;
  std::getline(lines, first);
  EXPECT_EQ(first, "0 0 0");
  EXPECT_EQ(run({"stream", program(), "-o", "-", "--format", "hal"}).output, lines.str());
}

TEST_F(Kcsctl, TwoAxisMachinesHaveNoZ) {
  const Result result = run({"stream", program(), "-o", "-", "--machine", "tajima-sencer-2016"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output.substr(0, result.output.find('\n')), "t,x,y");
}

TEST_F(Kcsctl, AFailureLeavesTheOldFileAlone) {
  std::ofstream(path("out.csv")) << "old";
  std::ofstream(path("bad.ngc")) << "G1 X1 F100\nG1 X#<x>\n";
  const Result result = run({"stream", path("bad.ngc"), "-o", path("out.csv")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(read(path("out.csv")), "old");
  EXPECT_EQ(files(), 3);
}

TEST_F(Kcsctl, LiveGivesWhatPlanAndStreamGive) {
  const Result live = run({"live", "--json", program(), "-o", path("live.csv"), "--period", "0.002"});
  ASSERT_EQ(live.exit_code, 0) << live.errors;
  EXPECT_EQ(live.output, run({"plan", "--json", program()}).output);
  ASSERT_EQ(run({"stream", program(), "-o", path("stream.csv"), "--period", "0.002"}).exit_code, 0);
  EXPECT_EQ(read(path("live.csv")), read(path("stream.csv")));
  EXPECT_NE(run({"live", program()}).output.find("Cycle time"), std::string::npos);
  EXPECT_EQ(run({"live", program(), "-o", "-"}).output.substr(0, 8), "t,x,y,z\n");
}

TEST_F(Kcsctl, LiveWritesSetpointsBeforeTheProgramEnds) {
  const fs::path pipe = path("program.pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ChildProcess kcsctl({KCSCTL, "live", pipe.string(), "-o", "-"});
  std::ofstream moves(pipe);
  for (int i = 1; i <= 1000; ++i) moves << "G1 F6000 X" << i << " Y" << i % 2 << "\n";
  moves.flush();
  EXPECT_EQ(kcsctl.read_line(), "t,x,y,z");
  EXPECT_EQ(kcsctl.read_line(), "0,0,0,0");
  moves.close();
  while (!kcsctl.read_line().empty()) continue;
  EXPECT_EQ(kcsctl.wait(), 0) << kcsctl.errors();
}

TEST_F(Kcsctl, LiveNamesFaultsAndLeavesNothingBehind) {
  std::ofstream(path("bad.ngc")) << "G1 X1 F100\nG1 X#<x>\n";
  const Result result = run({"live", path("bad.ngc"), "-o", path("out.csv")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.errors.rfind(path("bad.ngc") + ":2:", 0), 0) << result.errors;
  EXPECT_EQ(files(), 2) << "the two programs, nothing else";
  EXPECT_EQ(run({"live", path("none.ngc")}).exit_code, 4);
}

TEST_F(Kcsctl, SpeedsAtTheEndsAreTaken) {
  const json plan = json::parse(
      run({"plan", "--json", program(), "--start-speed", "20", "--start-acceleration", "50", "--end-speed", "10"})
          .output);
  EXPECT_EQ(plan["options"]["start_speed_mm_s"], 20);
  EXPECT_EQ(plan["options"]["start_acceleration_mm_s2"], 50);
  EXPECT_EQ(plan["options"]["end_speed_mm_s"], 10);
  const Result refused = run({"plan", program(), "--start-speed", "5000"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.errors.rfind("kcsctl: options.start_speed_mm_s: ", 0), 0) << refused.errors;
}

// As Ctrl-C does it. `env` sees to it that kcsctl listens to it, however the tests were started.
TEST_F(Kcsctl, AnInterruptedStreamLeavesNothingBehindAndIsOverForTheServer) {
  std::ofstream(path("far.ngc")) << "G1 X100000 F60\n";  // more than a day: ten thousand million setpoints
  KcsdProcess kcsd({KCSD, "--database", "memory", "--listen", "127.0.0.1:0"});
  ChildProcess kcsctl({"/usr/bin/env", "--default-signal=INT", KCSCTL, "stream", path("far.ngc"), "-o", path("out.csv"),
                       "--period", "1e-5", "--server", kcsd.address()});
  const fs::path half = path("out.csv." + std::to_string(kcsctl.pid()) + ".part");
  const auto deadline = Clock::now() + std::chrono::seconds(20);
  while (!(fs::exists(half) && fs::file_size(half) > 1'000'000)) {
    ASSERT_LT(Clock::now(), deadline) << "no setpoints come: " << kcsctl.errors();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kcsctl.send_signal(SIGINT);
  EXPECT_EQ(kcsctl.wait(), -SIGINT) << kcsctl.errors();
  EXPECT_EQ(files(), 2) << "the two programs, nothing else";

  const auto begin = Clock::now();
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(3)) << "kcsd waited for the interrupted stream";
}

TEST_F(Kcsctl, FaultsOfTheProgramNameFileLineAndColumn) {
  std::ofstream(path("bad.ngc")) << "G1 X1 F100\nG1 X#<x>\n";
  const Result result = run({"plan", path("bad.ngc")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.errors.rfind(path("bad.ngc") + ":2:", 0), 0) << result.errors;
  EXPECT_EQ(result.output, "");
}

TEST_F(Kcsctl, ExitCodesTellCausesApart) {
  EXPECT_EQ(run({"plan", program(), "--tolerance", "-1"}).exit_code, 1);
  EXPECT_EQ(run({"plan", program(), "--machine", path("none.toml")}).exit_code, 1);
  EXPECT_EQ(run({"plan", program(), "--strategy", "fast"}).exit_code, 2);
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"plan", program(), "--server", "unix:" + path("nobody")}).exit_code, 3);
  EXPECT_EQ(run({"plan", path("none.ngc")}).exit_code, 4);
  EXPECT_EQ(run({"stream", program(), "-o", path("no/such/folder.csv")}).exit_code, 4);
  EXPECT_EQ(run({"plot", program(), "-o", path("plot.pdf")}).exit_code, 4);
  EXPECT_EQ(run({"--help"}).exit_code, 0);
}

TEST_F(Kcsctl, AMissingServerIsNamedWithTheRemedy) {
  const std::string socket = "unix:" + path("nobody");
  EXPECT_EQ(run({"plan", program(), "--server", socket}).errors,
            "kcsctl: no kcsd answers at " + socket + "; start one with: kcsd --listen " + socket + "\n");
}

TEST_F(Kcsctl, TheServiceInsideAndARealServerGiveTheSameBytes) {
  KcsdProcess kcsd({KCSD, "--database", "memory", "--listen", "127.0.0.1:0"});
  const std::vector<std::vector<std::string>> commands = {
      {"plan", "--json", program()}, {"corners", "--json", program()}, {"stream", program(), "-o", "-"}};
  for (std::vector<std::string> command : commands) {
    const Result inside = run(command);
    command.insert(command.end(), {"--server", kcsd.address()});
    const Result remote = run(command);
    EXPECT_EQ(inside.exit_code, 0) << inside.errors;
    EXPECT_EQ(remote.exit_code, 0) << remote.errors;
    EXPECT_EQ(inside.output, remote.output) << command[0];
  }
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
}

TEST_F(Kcsctl, PlotDrawsAPicture) {
  ASSERT_EQ(run({"plot", program(), "-o", path("plot.svg")}).exit_code, 0);
  const std::string svg = read(path("plot.svg"));
  EXPECT_LT(svg.size(), 2'000'000);
  for (const char* text : {"<svg", "X, mm", "speed, mm/s", "acceleration, mm/s²", "jerk, mm/s³", "time, s", "</svg>"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  ASSERT_EQ(run({"plot", program(), "-o", path("plot.png"), "--from", "0.1", "--to", "0.2"}).exit_code, 0);
  EXPECT_EQ(read(path("plot.png")).substr(1, 3), "PNG");
  EXPECT_EQ(run({"plot", program(), "-o", path("none.svg"), "--from", "99"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(path("none.svg")));
}

}  // namespace
}  // namespace kcs::test
