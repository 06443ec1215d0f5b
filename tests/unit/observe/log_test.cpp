#include "server/observe/log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>

#include <memory>
#include <sstream>
#include <string>

namespace kcs::observe {
namespace {

class LogTest : public ::testing::Test {
 protected:
  Log log(LogFormat format) {
    const auto logger =
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(out_));
    logger->set_pattern("%v");
    return {logger, format};
  }

  std::ostringstream out_;
};

TEST_F(LogTest, TextHasTheFieldsAfterTheMessage) {
  log(LogFormat::kText).write(spdlog::level::info, "GetPlan done", {{"plan", "plans/1a"}, {"duration_s", 0.25}});
  EXPECT_EQ(out_.str(), "GetPlan done plan=plans/1a duration_s=0.25\n");
}

TEST_F(LogTest, TextQuotesWhatWouldLookLikeSomethingElse) {
  const Log text = log(LogFormat::kText);
  for (const auto& [value, written] : std::vector<std::pair<std::string, std::string>>{{"", R"("")"},
                                                                                       {"two words", R"("two words")"},
                                                                                       {"a=b", R"("a=b")"},
                                                                                       {"a\"b\\", R"("a\"b\\")"},
                                                                                       {"a\nb\x1b", R"("a\nb\u001b")"},
                                                                                       {"\xff", R"("\ufffd")"},
                                                                                       {"é", R"("\u00e9")"}}) {
    out_.str("");
    text.write(spdlog::level::info, "x", {{"field", value}});
    EXPECT_EQ(out_.str(), "x field=" + written + "\n");
  }
}

TEST_F(LogTest, JsonIsOneObjectALine) {
  const Log json = log(LogFormat::kJson);
  json.write(spdlog::level::warn, "two\nlines \xff", {{"owner", "a\nb"}, {"count", 7}});
  json.write(spdlog::level::err, "x", {});
  std::istringstream lines(out_.str());
  std::string line;
  std::getline(lines, line);
  const auto first = LogFields::parse(line);
  EXPECT_EQ(first["message"], "two\nlines \xef\xbf\xbd");
  EXPECT_EQ(first["level"], "warning");
  EXPECT_EQ(first["owner"], "a\nb");
  EXPECT_EQ(first["count"], 7);
  std::getline(lines, line);
  EXPECT_EQ(LogFields::parse(line).size(), 3U);
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(LogTest, TimeIsWrittenAsRfc3339Says) {
  const auto time = std::chrono::system_clock::from_time_t(1'700'000'000) + std::chrono::milliseconds(7);
  const auto line = LogFields::parse(json_line(time, spdlog::level::info, "x", {}));
  EXPECT_EQ(line["time"], "2023-11-14T22:13:20.007Z");
}

TEST_F(LogTest, WritesNothingBelowItsLevel) {
  log(LogFormat::kJson).write(spdlog::level::debug, "x", {{"a", 1}});
  EXPECT_EQ(out_.str(), "");
}

}  // namespace
}  // namespace kcs::observe
