#include "tests/store/postgres_server.h"

#include <fmt/format.h>
#include <libpq-fe.h>
#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace kcs::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPassword = "it's a \\ secret";
constexpr std::chrono::seconds kPatience{60};

// The programs of the newest version that is there.
fs::path programs() {
  std::vector<fs::path> versions;
  if (fs::exists("/usr/lib/postgresql")) {
    for (const auto& version : fs::directory_iterator("/usr/lib/postgresql")) {
      if (fs::exists(version.path() / "bin/initdb")) versions.push_back(version.path() / "bin");
    }
  }
  if (versions.empty()) {
    throw std::runtime_error("no PostgreSQL in /usr/lib/postgresql: install Debian's package postgresql");
  }
  return *std::ranges::max_element(versions);
}

const passwd& user() {
  const passwd* found = geteuid() == 0 ? getpwnam("postgres") : getpwuid(geteuid());
  if (!found) throw std::runtime_error("there is no user for PostgreSQL: install Debian's package postgresql");
  return *found;
}

std::string escaped(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'' || text[i] == '\\') text.insert(i++, 1, '\\');
  }
  return text;
}

// The process and all below it.
std::vector<pid_t> family(pid_t parent) {
  std::vector<pid_t> all = {parent};
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", parent));
  for (pid_t child = 0; children >> child;) {
    for (const pid_t member : family(child)) all.push_back(member);
  }
  return all;
}

}  // namespace

PostgresServer::PostgresServer() : password_file_(folder() / "password") {
  std::ofstream(password_file_) << kPassword << '\n';
  if (geteuid() == 0) {
    fs::permissions(folder(), fs::perms::all);
    fs::permissions(password_file_, fs::perms::owner_read | fs::perms::others_read);
  }
  run({programs() / "initdb", "--pgdata", folder() / "data", "--username", "kcs", "--pwfile", password_file_, "--auth",
       "scram-sha-256", "--encoding", "UTF8", "--locale", "C", "--no-sync"});
  start();
}

PostgresServer::~PostgresServer() {
  if (process_) kill();
}

std::string PostgresServer::create_database(const std::string& name) {
  query("postgres", "create database " + name);
  return fmt::format("postgresql:host={} user=kcs dbname={}", folder().string(), name);
}

std::string PostgresServer::query(const std::string& database, const std::string& statement) {
  const std::unique_ptr<PGconn, decltype(&PQfinish)> session(PQconnectdb(connection(database).c_str()), &PQfinish);
  const std::unique_ptr<PGresult, decltype(&PQclear)> result(PQexec(session.get(), statement.c_str()), &PQclear);
  const ExecStatusType status = PQresultStatus(result.get());
  if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) {
    throw std::runtime_error(statement + ": " + PQerrorMessage(session.get()));
  }
  return PQntuples(result.get()) > 0 ? PQgetvalue(result.get(), 0, 0) : "";
}

void PostgresServer::launch() {
  process_ = std::make_unique<ChildProcess>(
      as_its_user({programs() / "postgres", "-D", folder() / "data", "-k", folder(), "-c", "listen_addresses=", "-c",
                   "shared_buffers=16MB", "-c", "max_connections=40"}));
}

void PostgresServer::start() {
  launch();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (PQping(connection("postgres").c_str()) != PQPING_OK) {
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no answer: " + process_->errors());
    // After kill(), a process of the last one may need a moment to go.
    if (process_->errors().find("pre-existing shared memory") != std::string::npos) {
      process_->wait();
      launch();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void PostgresServer::stop() {
  process_->send_signal(SIGINT);
  process_->wait();
  process_.reset();
}

void PostgresServer::kill() {
  signal_all(SIGKILL);
  process_->wait();
  process_.reset();
}

void PostgresServer::freeze() { signal_all(SIGSTOP); }

void PostgresServer::thaw() { signal_all(SIGCONT); }

void PostgresServer::give(const fs::path& folder) const {
  if (chown(folder.c_str(), user().pw_uid, user().pw_gid) != 0) throw std::runtime_error("chown " + folder.string());
}

std::vector<std::string> PostgresServer::as_its_user(std::vector<std::string> command) const {
  std::vector<std::string> whole = {"/usr/bin/setpriv", "--pdeathsig", "QUIT"};
  if (geteuid() == 0) {
    whole.insert(whole.end(), {fmt::format("--reuid={}", user().pw_uid), fmt::format("--regid={}", user().pw_gid),
                               "--clear-groups"});
  }
  whole.insert(whole.end(), command.begin(), command.end());
  return whole;
}

void PostgresServer::run(const std::vector<std::string>& command) const {
  ChildProcess process(as_its_user(command));
  std::string output;
  for (std::string line = process.read_line(); !line.empty(); line = process.read_line()) output += line + '\n';
  if (process.wait() != 0) throw std::runtime_error(command[0] + " failed: " + output + process.errors());
}

std::string PostgresServer::connection(const std::string& database) const {
  return fmt::format("host={} user=kcs dbname={} password='{}'", folder().string(), database, escaped(kPassword));
}

void PostgresServer::signal_all(int number) const {
  for (const pid_t member : family(process_->pid())) ::kill(member, number);
}

}  // namespace kcs::test
