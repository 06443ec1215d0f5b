// HAProxy with the settings of deploy/compose, as a process of this machine.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"

namespace kcs::test {

class Balancer {
 public:
  // Where a server is to listen.
  struct Place {
    std::string address, http_address;  // the latter tells whether the server is ready
  };

  // Knows so many places; no server need run yet. Throws std::runtime_error if it does not start.
  explicit Balancer(std::size_t places);

  const std::string& address() const { return address_; }
  const Place& place(std::size_t number) const { return places_.at(number); }
  // Whether calls are sent to the server there, those about machines and all others.
  bool sends_to(std::size_t place) const;
  // What it has said.
  std::string errors() const { return process_->errors(); }

 private:
  std::string settings() const;

  TemporaryFolder folder_;
  std::vector<Place> places_;
  std::string address_, figures_address_;
  std::unique_ptr<ChildProcess> process_;
};

}  // namespace kcs::test
