#include "client/cli/pending_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace kcs::cli {
namespace {

namespace fs = std::filesystem;

class PendingFileTest : public testing::Test {
 protected:
  PendingFileTest() { fs::create_directories(folder_); }
  ~PendingFileTest() override { fs::remove_all(folder_); }

  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("pending_file_test." + std::to_string(::getpid()));
  const fs::path name_ = folder_ / "out.csv";
};

TEST_F(PendingFileTest, TheNameAppearsOnlyOnCommit) {
  PendingFile file(name_);
  write(file.path(), "all of it");
  EXPECT_FALSE(fs::exists(name_));
  file.commit();
  EXPECT_EQ(read(name_), "all of it");
  EXPECT_EQ(files(), 1);
}

TEST_F(PendingFileTest, AFailureKeepsTheOldFileAndLeavesNothingElse) {
  write(name_, "old");
  {
    PendingFile file(name_);
    write(file.path(), "half");
  }
  EXPECT_EQ(read(name_), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(PendingFileTest, ASignalEndsTheProcessAndLeavesNothing) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const auto be_interrupted = [this, number] {
      signal(number, SIG_DFL);
      PendingFile file(name_);
      write(file.path(), "half");
      kill(getpid(), number);
      while (true) pause();
    };
    EXPECT_EXIT(be_interrupted(), testing::KilledBySignal(number), "");
    EXPECT_EQ(files(), 0) << "after signal " << number;
  }
}

TEST_F(PendingFileTest, SignalsThatAreIgnoredStayIgnored) {
  const auto be_hung_up = [this] {
    signal(SIGHUP, SIG_IGN);
    PendingFile file(name_);
    write(file.path(), "all of it");
    kill(getpid(), SIGHUP);
    usleep(50'000);
    file.commit();
    std::exit(0);
  };
  EXPECT_EXIT(be_hung_up(), testing::ExitedWithCode(0), "");
  EXPECT_EQ(read(name_), "all of it");
}

TEST_F(PendingFileTest, SignalsEndTheProcessAsEverWhenTheFileIsDone) {
  const auto be_interrupted = [this] {
    signal(SIGINT, SIG_DFL);
    {
      PendingFile file(name_);
      write(file.path(), "all of it");
      file.commit();
    }
    kill(getpid(), SIGINT);
    while (true) pause();
  };
  EXPECT_EXIT(be_interrupted(), testing::KilledBySignal(SIGINT), "");
}

TEST_F(PendingFileTest, ALinkGoesOnPointingToTheFile) {
  write(name_, "old");
  fs::create_symlink(name_, folder_ / "link");
  PendingFile file(folder_ / "link");
  write(file.path(), "new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read(name_), "new");
}

TEST_F(PendingFileTest, DevicesAreWrittenInPlace) {
  PendingFile file("/dev/null");
  EXPECT_EQ(file.path(), "/dev/null");
  file.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace kcs::cli
