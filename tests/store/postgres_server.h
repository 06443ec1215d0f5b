// A PostgreSQL server of a test's own, from the programs of Debian's package postgresql.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"

namespace kcs::test {

// Runs from construction to destruction, in a temporary folder and behind a socket there. It never runs as root, which
// it refuses, but as the user postgres then. Throws std::runtime_error with what the programs said if one fails.
class PostgresServer {
 public:
  PostgresServer();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  // Makes an empty database; how to connect to it, as a setting of kcsd, without the password.
  std::string create_database(const std::string& name);
  // A file with the password.
  const std::filesystem::path& password_file() const { return password_file_; }

  // Runs a statement in a database: the first value of its result, empty if there is none.
  std::string query(const std::string& database, const std::string& statement);

  void start();
  // An orderly stop that cuts the connections.
  void stop();
  // The end of all its processes without a word, as at a power failure of its host.
  void kill();
  // Its processes stand still: connections stay, but nobody answers.
  void freeze();
  void thaw();

  // Gives a folder to the server's user.
  void give(const std::filesystem::path& folder) const;

  // The folder of the server, where its user may write.
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  void launch();
  std::vector<std::string> as_its_user(std::vector<std::string> command) const;
  void run(const std::vector<std::string>& command) const;
  std::string connection(const std::string& database) const;
  void signal_all(int number) const;

  TemporaryFolder folder_;
  std::filesystem::path password_file_;
  std::unique_ptr<ChildProcess> process_;
};

}  // namespace kcs::test
