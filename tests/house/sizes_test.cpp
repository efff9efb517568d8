#include <gtest/gtest.h>

#include <iostream>

#include "code_scanner.h"
#include "source_tree.h"

namespace swept::house {
namespace {

constexpr int kMaxFileLines = 800;
constexpr int kTargetFileLines = 400;
constexpr int kMaxFunctionLines = 100;

TEST(Sizes, OfFiles) {
    const std::vector<SourceFile> files = allCppFiles();
    for (const SourceFile& file : files) {
        const int lines = lineCount(file.text);
        EXPECT_LE(lines, kMaxFileLines) << file.path;
        if (lines > kTargetFileLines) { std::cout << "[   NOTE   ] " << file.path << " has " << lines << " lines\n"; }
    }
    EXPECT_GT(files.size(), 50U);
}

TEST(Sizes, OfFunctions) {
    std::size_t functions = 0;
    for (const SourceFile& file : allCppFiles()) {
        for (const FunctionSpan& function : functionsIn(file.text)) {
            ++functions;
            EXPECT_LE(function.lines(), kMaxFunctionLines)
                << file.path << ':' << function.firstLine << ": " << function.head;
        }
    }
    EXPECT_GT(functions, 300U) << "the scan found hardly anything";
}

}  // namespace
}  // namespace swept::house
