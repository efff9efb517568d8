#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include <swept/samples/scene_builder.h>
#include <swept/tools/tune/config.h>
#include <swept/tools/tune/limits.h>
#include <swept/tools/tune/verdict.h>

/// What the search tells of costs and of errors that are missed.

namespace swept::tune {
namespace {

using measures::Measure;

TEST(TuneVerdict, TellsWhatAdviceCosts) {
    EXPECT_EQ(costText(0.4, 1, true), ": 0.4 of what the scene costs now");
    EXPECT_EQ(costText(0.95, 1, true), ": no saving that could be measured");
    EXPECT_EQ(costText(0, 1, true), "");
    // What keeps the errors may well cost more than what does not.
    EXPECT_EQ(costText(1.24, 1, false), ": 1.24 times what the scene costs now, which does not keep these errors");
    EXPECT_EQ(costText(0.95, 1, false), ": about what the scene costs now, which does not keep these errors");
    EXPECT_EQ(costText(0.4, 1, false), ": 0.4 of what the scene costs now, which does not keep these errors");
}

TEST(TuneLimits, OfNothingThereAreNoParts) {
    const Subject subject{build::scene("empty", {0, 0}, 10), 16};
    const measures::Values certain;
    const std::vector<Limit> nothing{{Measure::penetration, 0, false}};
    Knowledge known;
    known.rows.resize(1);
    known.rows[0].config = ownConfig(subject.scene);
    known.rows[0].cost = 1;
    const auto lastRow = [&] {
        std::ostringstream out;
        writeTable(out, subject, nothing, known, judge(subject, known, nothing));
        const std::string rows = out.str().substr(0, out.str().find("\n> recommended"));
        return rows.substr(rows.find_last_of("\n") + 1);
    };
    for (const double error : {1e-30, 0.002}) {  // the first one is lost beside 1
        known.rows[0].errors[Measure::penetration] = error;
        EXPECT_FALSE(holds(strain(known.rows[0], nothing, certain))) << error;
        EXPECT_TRUE(lastRow().ends_with("over")) << lastRow();
    }
    known.rows[0].errors[Measure::penetration] = 0;
    EXPECT_TRUE(lastRow().ends_with(" 0 %")) << lastRow();
}

TEST(TuneLimits, ThoseThatAreMissedAreTold) {
    Row row;
    row.errors[Measure::penetration] = 0.0123;
    row.errors[Measure::missedHits] = 2;
    const std::vector<Limit> limits{{Measure::penetration, 0.002, false}, {Measure::missedHits, 0, true}};
    EXPECT_EQ(missedText(row, limits, {}), "penetration 0.0123 instead of 0.002 m, missed-hits 2 instead of 0");
    EXPECT_EQ(missedText(row, {{Measure::penetration, 0.02, false}}, {}), "");
}

}  // namespace
}  // namespace swept::tune
