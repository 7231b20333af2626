#include "evaluation/alarm_text.h"

#include <gtest/gtest.h>

#include "evaluation/report.h"

namespace slipnav {
namespace {

const Alarms kAlarms = {{"a \"late\" one", {fromSeconds(102.5), fromSeconds(104.0), 3}},
                        {"b", {fromSeconds(101.0), fromSeconds(101.0), 1}}};

TEST(AlarmText, tellsTheEarliestFirst) {
  EXPECT_EQ(alarmLines("evaluate: alarm", kAlarms, fromSeconds(100.0)),
            "evaluate: alarm: b (1 time, 1.0 s)\n"
            "evaluate: alarm: a \"late\" one (3 times, 2.5 s to 4.0 s)\n");
}

TEST(AlarmText, standsInTheMetrics) {
  Metrics metrics;
  metrics.alarms = kAlarms;
  metrics.verdict = "consistent";
  const std::string json = metricsJson(metrics);
  EXPECT_NE(json.find("\"alarms\": [\n"
                      "    {\"what\": \"b\", \"count\": 1, \"first_s\": 101.000000000, \"last_s\": 101.000000000},\n"
                      "    {\"what\": \"a \\\"late\\\" one\", \"count\": 3, \"first_s\": 102.500000000, "
                      "\"last_s\": 104.000000000}\n  ]"),
            std::string::npos)
      << json;
  EXPECT_NE(json.find("\"problems\": []"), std::string::npos) << json;
  EXPECT_NE(json.find("\"verdict\": \"consistent\""), std::string::npos) << json;
}

}  // namespace
}  // namespace slipnav
