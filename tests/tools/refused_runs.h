#pragma once

#include <string>
#include <vector>

#include "run_program.h"
#include "small_scenes.h"

namespace swept {

/// Commands on a scene of a ball that are refused, and then leave nothing in the folder for outputs.
class RefusedRuns : public testing::Test {
protected:
    void expectNothingWritten(const std::vector<std::string>& arguments, const std::string& reason) {
        expectRefused(arguments, reason);
        EXPECT_TRUE(out_.isEmpty()) << "a refused run must write nothing: " << reason;
    }

    ScratchDirectory in_;
    ScratchDirectory out_;
    std::string scene_ = in_.write("ball.json", kBallScene);
};

}  // namespace swept
