// Why a request may get no plan although nothing is wrong with it.
#pragma once

#include <exception>

namespace kcs::jobs {

// Nobody wants the plan any more: it was cancelled by its name, or all who waited for it went away.
class Withdrawn : public std::exception {
 public:
  const char* what() const noexcept override {
    return "the plan was deleted, or all who asked for it gave up, before it was made; send its request again";
  }
};

}  // namespace kcs::jobs
