#include "server/jobs/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

#include "server/jobs/cap_exceeded.h"

namespace kcs::jobs {
namespace {

TEST(WorkerPool, RunsEveryTask) {
  std::atomic<int> run = 0;
  std::promise<void> all;
  WorkerPool pool(3, 1000);
  for (int i = 0; i < 500; ++i) {
    pool.submit([&] {
      if (++run == 500) all.set_value();
    });
  }
  all.get_future().wait();
  EXPECT_EQ(run, 500);
}

TEST(WorkerPool, RefusesWhatDoesNotFitIntoTheQueue) {
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  {
    WorkerPool pool(2, 3);
    for (int i = 0; i < 5; ++i) pool.submit([opened] { opened.wait(); });
    EXPECT_THROW(pool.submit([] {}), CapExceeded);
    gate.set_value();
  }
}

TEST(WorkerPool, DropsWhatStillWaitsWhenItGoes) {
  std::atomic<bool> dropped_task_ran = false;
  std::promise<void> running;
  std::promise<void> gate;
  std::thread opener;
  {
    WorkerPool pool(1, 10);
    pool.submit([&, opened = gate.get_future().share()] {
      running.set_value();
      opened.wait();
    });
    running.get_future().wait();
    pool.submit([&] { dropped_task_ran = true; });
    opener = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the pool is being destroyed by then
      gate.set_value();
    });
  }
  opener.join();
  EXPECT_FALSE(dropped_task_ran);
}

}  // namespace
}  // namespace kcs::jobs
