// The view of a run on a terminal, and the keys that operate it.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "client/cli/operator_keys.h"
#include "client/cli/terminal.h"
#include "client/sdk/machines.h"

namespace kcs::cli {

class RunScreen {
 public:
  // run: as it is now. Keeps references to `terminal` and `machines`. take_over: the keys control the run even if
  // somebody else does.
  RunScreen(Terminal& terminal, client::Machines& machines, client::Run run, bool take_over);

  // Until the run is over, or the operator leaves; returns the run as it was last. While the server cannot be reached
  // it says so, and tries again. Throws client::Error if the server does not know the run (any more).
  client::Run show();

 private:
  // The run as it is told last, and what there is to say about the connection.
  struct News {
    client::Run run;
    std::string trouble;  // empty: none
    std::exception_ptr fault;
  };

  void follow(const std::stop_token& stop);
  News news();
  void draw();
  void obey(Order order);
  client::Run carry_out(Order order);

  Terminal& terminal_;
  client::Machines& machines_;
  const std::string name_;
  const bool take_over_;
  const double window_s_;
  OperatorKeys keys_;
  std::string answer_;  // to the last order, if it was refused
  std::mutex mutex_;    // of news_
  std::condition_variable_any stopped_;
  News news_;
};

}  // namespace kcs::cli
