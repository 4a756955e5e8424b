// The messages to a worker and back.
#include "fuzz/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

using nlohmann::json;

const Family kFamily{"pop", "human", "head/neck"};

std::string with(const std::string& message, const char* name, const json& value) {
  json changed = json::parse(message);
  changed[name] = value;
  return changed.dump();
}

TEST(Messages, TasksArriveAsTheyWereSent) {
  const Task tasks[] = {EvaluateTask{{3, 9}},
                        EvaluateTask{{3}, {"crash", "human", "SIGSEGV"}},
                        SettleTask{{3, 9}, kFamily, 2, "0123456789abcdef", true, false},
                        SettleTask{{3}, kFamily, 0, "0123456789abcdef", false, true, "fedcba9876543210"},
                        ShrinkTask{"corpus/leads/seed_1/0123456789ab-0000000000000001.json", true}};
  for (const Task& task : tasks) EXPECT_EQ(parse_task(print_task(task)), task) << print_task(task);
}

TEST(Messages, ATaskHasTheFieldsOfItsOwnType) {
  const std::string settle = print_task(SettleTask{{3}, kFamily, 0, "", false, true});
  EXPECT_THROW(parse_task(with(settle, "lead", "x")), std::logic_error);
  EXPECT_THROW(parse_task(with(settle, "type", "evaluate")), std::logic_error);
  EXPECT_THROW(parse_task(with(settle, "type", "unheard_of")), std::logic_error);
  EXPECT_THROW(parse_task(with(settle, "family", "pop")), std::logic_error);
  EXPECT_THROW(parse_task("{}"), std::logic_error);
}

TEST(Messages, ReportsArriveAsTheyWereSent) {
  const EvaluateReport evaluated{.built = true,
                                 .frames = 60,
                                 .motion_hash = "0123456789abcdef",
                                 .tested = {"ground steps"},
                                 .unmet = {"reach on arm_left: out_of_reach"},
                                 .not_judged = {"balance: the motion has no dynamics"},
                                 .broken = {kFamily},
                                 .near = {{kFamily, 0.1}},
                                 .waivers = {{3, true}}};
  EXPECT_EQ(parse_report<EvaluateReport>(print_report(evaluated)), evaluated);
  EvaluateReport compared = evaluated;
  compared.against = Comparison{"", true, 17, "fedcba9876543210", {kFamily}, {kFamily}, {kFamily}};
  EXPECT_EQ(parse_report<EvaluateReport>(print_report(compared)), compared);
  compared.against = Comparison{"base.crash: gone", false, -1, "", {}, {}, {}};
  EXPECT_EQ(parse_report<EvaluateReport>(print_report(compared)), compared);
  SettledLead settled{{"seed_1", made_up(170, 60, 1), made_up(160, 30, 1)}, true, {}, {}};
  settled.lead.shrunk_from = made_up(171, 61, 1);
  settled.lead.minimal->co_failures = {kFamily};
  settled.incidental = {settled.lead};
  settled.incidental_of_base = {kFamily};
  settled.incidental_unconfirmed = {{"seed_1", made_up(172, 62, 1), {}}};
  const SettleReport report{settled, ""};
  EXPECT_EQ(parse_report<SettleReport>(print_report(report)), report);
  const ShrinkReport shrunk{settled, "file.unwritable: no room"}, gone;
  EXPECT_EQ(parse_report<ShrinkReport>(print_report(shrunk)), shrunk);
  EXPECT_EQ(parse_report<ShrinkReport>(print_report(gone)), gone);
}

// A lead in a message equals the stored one.
TEST(Messages, ALeadWithoutANumberKeepsThat) {
  const SettleReport report{{{"seed_1", made_up_nan(made_up(170, 60, 1)), {}}, false, {}, {}}, ""};
  const Case read = parse_report<SettleReport>(print_report(report)).settled.lead.original;
  EXPECT_TRUE(std::isnan(read.expect.worst_margin));
  EXPECT_EQ(print_case(read), print_case(report.settled.lead.original));
}

TEST(Messages, AReportIsOfItsTask) {
  EXPECT_THROW(parse_report<SettleReport>(print_report(EvaluateReport{})), std::logic_error);
  EXPECT_THROW(parse_report<EvaluateReport>(print_report(ShrinkReport{})), std::logic_error);
  EXPECT_THROW(parse_report<EvaluateReport>(with(print_report(EvaluateReport{}), "confirmed", true)), std::logic_error);
}

}  // namespace
}  // namespace contort
