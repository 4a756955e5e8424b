// Leads: failures that were found and are in no bucket yet.
#include "corpus/leads.h"

#include <gtest/gtest.h>

#include "tests/checks/family_text.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

TEST(Leads, TellWhatTheirMinimalSpecShows) {
  Lead lead{"seed_1", made_up(170, 60, 1), {}};
  EXPECT_TRUE(families_told_by(lead).empty());
  lead.minimal = made_up(160, 30, 1);
  lead.minimal->co_failures = {family("pop|human|head/neck")};
  EXPECT_EQ(families_told_by(lead), (std::set<Family>{family_of(lead.original), family("pop|human|head/neck")}));
}

TEST(Leads, ReadBackAsTheyWereKept) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  Lead lead{"seed_1", made_up(170, 60, 1), made_up(160, 30, 1)};
  lead.original.provenance.index = 7;
  lead.original.provenance.met_shrinking = family("pop|human|head/neck");
  const Result<std::string> path = keep_lead(corpus, lead);
  ASSERT_TRUE(path) << to_line(path.issue());
  EXPECT_EQ(*path, lead_path(corpus, lead));
  EXPECT_EQ(*read_lead(*path), lead);
}

TEST(Leads, OfFilesThatNameNoFamilyAreRefused) {
  std::string text = print_case(made_up(170, 60, 1));
  text.insert(text.find('{') + 1, "\"also\": [\"pop|human|head/neck\", \"pop\"],");
  const Result<Case> read = parse_case(text);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.issue().code, "case.bad_family");
  EXPECT_EQ(read.issue().pointer, "/also/1");
}

}  // namespace
}  // namespace contort
