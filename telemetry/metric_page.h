// Numbers of a running program in the text format that Prometheus reads.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "prometheus/metric_family.h"

namespace lambert {

class MetricPage {
 public:
  using Labels = std::vector<std::pair<std::string, std::string>>;

  // Names begin with lambert_ and end in their unit. One name may be given several times, one after
  // the other, with different labels.
  void Gauge(const std::string& name, const std::string& help, double value,
             const Labels& labels = {});
  // A number that only grows while the program runs; its name ends in _total.
  void Counter(const std::string& name, const std::string& help, double value,
               const Labels& labels = {});

  std::string Text() const;

 private:
  prometheus::ClientMetric& Add(const std::string& name, const std::string& help,
                                prometheus::MetricType type, const Labels& labels);

  std::vector<prometheus::MetricFamily> families_;
};

}  // namespace lambert
