// The benchmarks, and the rows that they give to the table.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tests/bench/speed/table.h"

namespace kcs::bench {

// Planning: generated paths of all kinds, AUTO against the paper's strategies; the share of verification.
void add_planning(Table& table);

// Does planning stay in proportion? 20,000, 200,000 and 2,000,000 segments: time and memory of each.
void add_scaling(Table& table);

// From G-code to a path and to a plan: of a generated program, or of files.
void add_reading(Table& table);
void add_programs(Table& table, std::span<char*> files);

// From a plan to setpoints, and over a connection to a server.
void add_sampling(Table& table);
void add_streaming(Table& table);

// A copy of so many bytes from memory to memory: what reading and sampling are compared with.
void add_memory_copy(const std::string& name, std::size_t bytes);

// A counter of so many a second, for a benchmark that does so many in each iteration.
benchmark::Counter rate(double per_iteration);

}  // namespace kcs::bench
