// What can go wrong with the store. what() gives the reason and the remedy; the reason may name the database's host or
// file, so it is for the log rather than for strangers.
#pragma once

#include <stdexcept>

namespace kcs::store {

// The store needs a person: a file that is no database, a schema of a newer version, a missing right, a damaged row.
// Trying again does not help.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The database cannot be reached or does not answer in time. Trying again later may help; nothing else is needed, for
// the store connects by itself once the database is back.
class StoreUnavailable : public StoreError {
 public:
  using StoreError::StoreError;
};

// The disk of the database is full: reading goes on, writing needs room first.
class StoreFull : public StoreError {
 public:
  using StoreError::StoreError;
};

// A new run for a machine that has one which is not over.
class MachineHasRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A new run of a plan that is not kept, or not any more.
class PlanNotKept : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A page token that this list did not give.
class InvalidPageToken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kcs::store
