// One connection of the HTTP end point, which cannot be held open for long or filled up.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace kcs::observe {

// cpp-httplib limits the time between two bytes only, and the length of each line only: by this a client cannot send
// one byte every few seconds for hours, or headers without end. Closes the socket at its end.
//
// A request may be allowed more: a body of any length that comes fast enough, and an answer that takes as long as its
// client waits for it.
class HttpConnection final : public httplib::Stream {
 public:
  // `socket`: a connected one. `patience`: for everything. `most_bytes`: of the request in all.
  HttpConnection(socket_t socket, std::chrono::nanoseconds patience, std::size_t most_bytes)
      : socket_(socket),
        patience_(patience),
        end_(std::chrono::steady_clock::now() + patience),
        bytes_left_(most_bytes) {}
  ~HttpConnection() override;

  // The answer may come late; its writing has as much time as everything had before.
  void allow_late_answer() { late_answer_ = true; }
  // What is read from now on may be of any length, but must come at 64 KiB a second on the average.
  void allow_body();
  // Whether the client still waits: it has neither gone nor said that it sends no more.
  bool client_waits() const;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  // Waits until the socket can be used so, or the time is over.
  bool wait_for(short events) const;

  void let_client_read() const;

  socket_t socket_;
  std::chrono::nanoseconds patience_;
  std::chrono::steady_clock::time_point end_;
  std::size_t bytes_left_;
  bool late_answer_ = false;
  bool answers_ = false;                       // has begun to write
  std::chrono::nanoseconds time_per_byte_{0};  // that is granted for the reading of the next ones
};

}  // namespace kcs::observe
