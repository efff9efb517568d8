#include <gtest/gtest.h>

#include <string>

#include <swept/tools/writers/gnuplot_text.h>

namespace swept {
namespace {

TEST(GnuplotText, NothingEndsTheString) {
    EXPECT_EQ(gnuplotQuoted(""), "''");
    EXPECT_EQ(gnuplotQuoted("two \"crates\" @HOME `date` \\"), "'two \"crates\" @HOME `date` \\'");
    EXPECT_EQ(gnuplotQuoted("it's ü"), "'it''s ü'");
    EXPECT_EQ(gnuplotQuoted("a\n!touch b\r\n\tc\x7F"), "'a !touch b   c '");
    EXPECT_EQ(gnuplotQuoted(std::string("a\0b", 3)), "'a b'");
}

}  // namespace
}  // namespace swept
