// One connection of the HTTP end point, which cannot be held open for long or filled up.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace kcs::observe {

// cpp-httplib limits the time between two bytes only, and the length of each line only: by this a client cannot send
// one byte every few seconds for hours, or headers without end. Closes the socket at its end.
class HttpConnection final : public httplib::Stream {
 public:
  // `socket`: a connected one. `most_bytes`: of the request in all.
  HttpConnection(socket_t socket, std::chrono::steady_clock::time_point end, std::size_t most_bytes)
      : socket_(socket), end_(end), bytes_left_(most_bytes) {}
  ~HttpConnection() override;

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

  socket_t socket_;
  std::chrono::steady_clock::time_point end_;
  std::size_t bytes_left_;
};

}  // namespace kcs::observe
