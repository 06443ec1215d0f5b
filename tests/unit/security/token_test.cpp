// Tokens and their hashes.
#include "server/security/token.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "server/security/token_commands.h"

namespace kcs::security {
namespace {

TEST(Token, NewOnesAreAllowedAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) {
    const std::string token = new_token();
    EXPECT_NO_THROW(require_token(token));
    EXPECT_TRUE(tokens.insert(token).second);
  }
}

TEST(Token, ThatCouldBeGuessedOrCannotBeSentIsRefusedWithoutBeingShown) {
  for (const std::string token : {"", "hunter2", "nineteen-characters", "has a blank in the middle",
                                  "has\ta\ttab\tin it---", "has \xc3\xa4 letters beyond ASCII"}) {
    try {
      require_token(token);
      FAIL() << token;
    } catch (const std::runtime_error& refused) {
      EXPECT_TRUE(token.empty() || std::string(refused.what()).find(token) == std::string::npos) << refused.what();
    }
  }
  EXPECT_NO_THROW(require_token("twenty.characters_~+"));
}

TEST(TokenHash, IsTheSha256) {
  // From FIPS 180-2, appendix B.1.
  EXPECT_EQ(TokenHash::of("abc").text(), "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(TokenHash, IsReadAsItIsWritten) {
  const TokenHash hash = TokenHash::of("some token");
  EXPECT_TRUE(TokenHash::parse(hash.text()) == hash);
  EXPECT_FALSE(TokenHash::parse(hash.text()) == TokenHash::of("some Token"));
}

TEST(TokenHash, ThatIsNoneIsRefused) {
  const std::string good = TokenHash::of("some token").text();
  for (const std::string& bad :
       {std::string(), std::string("sha256:"), good.substr(7), good.substr(0, good.size() - 1), good + "0",
        "sha512:" + good.substr(7), "sha256:" + std::string(64, 'g'), "sha256:" + std::string(64, 'A')}) {
    EXPECT_THROW(TokenHash::parse(bad), std::runtime_error) << bad;
  }
}

TEST(TokenCommands, HashWhatTheyMake) {
  std::ostringstream token;
  std::ostringstream line;
  make_token(token, line);
  std::istringstream in(token.str());
  std::ostringstream hashed;
  hash_token(in, hashed);
  EXPECT_EQ(hashed.str(), line.str());
  EXPECT_TRUE(line.str().starts_with("hash = \"sha256:")) << line.str();
}

TEST(TokenCommands, TakeTheFirstLineHoweverItEnds) {
  const std::string token = "twenty.characters_~+";
  for (const std::string end : {"", "\n", "\r\n", "\nmore"}) {
    std::istringstream in(token + end);
    std::ostringstream hashed;
    hash_token(in, hashed);
    EXPECT_EQ(hashed.str(), "hash = \"" + TokenHash::of(token).text() + "\"\n");
  }
  std::istringstream empty;
  std::ostringstream hashed;
  EXPECT_THROW(hash_token(empty, hashed), std::runtime_error);
}

}  // namespace
}  // namespace kcs::security
