// The cable between a client and a server, for tests that pull it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace kcs::test {

// Forwards TCP connections on this machine to a server on this machine.
class Cable {
 public:
  // Throws std::system_error if there is no port.
  explicit Cable(int server_port);
  ~Cable();
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;

  // Where clients reach the server through it.
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  // While it is cut, connections break, and new ones at once.
  void cut(bool is_cut) { cut_ = is_cut; }
  // While it stalls, nothing comes through, and nothing breaks.
  void stall(bool stalls) { stalls_ = stalls; }
  // What the server sends comes so much later, piece by piece.
  void delay(std::chrono::milliseconds delay) { delay_ = delay; }
  // What is connected gets nothing any more, for ever, and is not told so; new connections are well.
  void abandon() { ++abandoned_; }
  // Changes a byte of what the server sends next.
  void corrupt() { corrupts_ = true; }

 private:
  void run(const std::stop_token& stop);
  void connect_through(int client, const std::stop_token& stop);
  void disturb(char* data, ssize_t size);

  int server_port_;
  int listener_ = -1;
  int port_ = 0;
  std::atomic<bool> cut_ = false;
  std::atomic<bool> stalls_ = false;
  std::atomic<bool> corrupts_ = false;
  std::atomic<int> abandoned_ = 0;  // times
  std::atomic<std::chrono::milliseconds> delay_{};
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::test
