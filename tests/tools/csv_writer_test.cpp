#include <gtest/gtest.h>

#include <sstream>

#include <swept/tools/writers/csv_writer.h>

namespace swept {
namespace {

TEST(CsvWriter, WritesTheFormatByteForByte) {
    std::ostringstream out;
    CsvWriter writer(out, {"floor", "ball"});
    Frame frame;
    frame.bodies = {{{0, 0}, 0, {0, 0}, 0, false}, {{0, 5}, 0.25, {1, -0.5}, 3, true}};
    writer.write(frame);
    frame.step = 1;
    frame.time = 1.0 / 60.0;
    frame.bodies[1] = {{1.0 / 3.0, 4.9}, -6.5, {1e-7, 1e30}, -0.0, false};
    writer.write(frame);
    EXPECT_EQ(out.str(),
              "step,time,body,x,y,angle,vx,vy,omega,awake\n"
              "0,0,floor,0,0,0,0,0,0,0\n"
              "0,0,ball,0,5,0.25,1,-0.5,3,1\n"
              "1,0.016666666666666666,floor,0,0,0,0,0,0,0\n"
              "1,0.016666666666666666,ball,0.3333333333333333,4.9,-6.5,1e-07,1e+30,-0,0\n");
}

TEST(CsvWriter, WritesTheBodiesThatAreAskedForInTheOrderOfTheScene) {
    std::ostringstream out;
    CsvWriter writer(out, {"floor", "ball", "box"}, {2, 0, 2});
    Frame frame;
    frame.bodies = {{{0, 0}, 0, {0, 0}, 0, false}, {{0, 5}, 0, {0, 0}, 0, true}, {{1, 2}, 0, {0, 0}, 0, true}};
    writer.write(frame);
    EXPECT_EQ(out.str(),
              "step,time,body,x,y,angle,vx,vy,omega,awake\n0,0,floor,0,0,0,0,0,0,0\n0,0,box,1,2,0,0,0,0,1\n");
}

TEST(CsvWriter, QuotesNamesByRfc4180) {
    EXPECT_EQ(csvField("plain name"), "plain name");
    EXPECT_EQ(csvField("a,b"), "\"a,b\"");
    EXPECT_EQ(csvField("say \"hi\""), "\"say \"\"hi\"\"\"");
    EXPECT_EQ(csvField("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csvField("carriage\rreturn"), "\"carriage\rreturn\"");
    EXPECT_EQ(csvField(""), "");
    EXPECT_EQ(csvField("semi;colon"), "semi;colon");
}

TEST(CsvWriter, QuotesNamesInRows) {
    std::ostringstream out;
    CsvWriter writer(out, {"a \"b\", c"});
    Frame frame;
    frame.bodies = {{{1, 2}, 0, {0, 0}, 0, true}};
    writer.write(frame);
    EXPECT_EQ(out.str(), "step,time,body,x,y,angle,vx,vy,omega,awake\n0,0,\"a \"\"b\"\", c\",1,2,0,0,0,0,1\n");
}

}  // namespace
}  // namespace swept
