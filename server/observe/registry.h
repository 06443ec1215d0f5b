// All figures of a server, as they are shown to Prometheus.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/observe/counter.h"
#include "server/observe/family.h"
#include "server/observe/gauge.h"
#include "server/observe/histogram.h"

namespace kcs::observe {

// Metrics are added once and live as long as the registry. Each of the methods that add one throws std::logic_error if
// its name is taken, or none that Prometheus takes. Safe for use by many threads at once.
class Registry {
 public:
  // A metric without labels.
  Counter& counter(Description description) { return counters(std::move(description)).with({}); }
  Gauge& gauge(Description description) { return gauges(std::move(description)).with({}); }
  Histogram& histogram(Description description) { return histograms(std::move(description)).with({}); }

  // A metric with labels.
  Family<Counter>& counters(Description description) { return family<Counter>(std::move(description)); }
  Family<Gauge>& gauges(Description description) { return family<Gauge>(std::move(description)); }
  Family<Histogram>& histograms(Description description) { return family<Histogram>(std::move(description)); }

  // A number that is read whenever the figures are shown, by any thread. `read` must not use the registry, and what it
  // reads must be there as long as figures are shown. A counter's number never falls.
  void read_gauge(Description description, std::function<double()> read);
  void read_counter(Description description, std::function<double()> read);

  // All of it in the text exposition format, in the order in which it was added.
  std::string exposition() const;

 private:
  template <typename Metric>
  Family<Metric>& family(Description description) {
    auto metric = std::make_unique<Family<Metric>>(std::move(description));
    Family<Metric>& added = *metric;
    add(std::move(metric));
    return added;
  }

  void add(std::unique_ptr<Exposed> metric);

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Exposed>> metrics_;
};

}  // namespace kcs::observe
