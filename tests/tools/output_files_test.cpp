#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <thread>

#include <sys/stat.h>

#include <swept/tools/writers/output_files.h>

#include "scratch_directory.h"

namespace swept {
namespace {

TEST(OutputFiles, OpensAllPlaces) {
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addFile("--csv", scratch.path("a.csv"));
    outputs.addFile("--report", "");
    outputs.addDirectory("--png", scratch.path("deep/er"));
    std::string error;
    ASSERT_TRUE(outputs.open(error)) << error;
    EXPECT_EQ(outputs.stream(""), nullptr);
    *outputs.stream(scratch.path("a.csv")) << "text";
    ASSERT_TRUE(outputs.close(error)) << error;
    EXPECT_EQ(scratch.read("a.csv"), "text");
    EXPECT_TRUE(std::filesystem::is_directory(scratch.path("deep/er")));
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path("deep/er")));
}

TEST(OutputFiles, CutsOffWhatAnEarlierRunLeft) {
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addFile("--csv", scratch.write("a.csv", "a long text of an earlier run"));
    std::string error;
    ASSERT_TRUE(outputs.open(error)) << error;
    *outputs.stream(scratch.path("a.csv")) << "new";
    ASSERT_TRUE(outputs.close(error));
    EXPECT_EQ(scratch.read("a.csv"), "new");
}

TEST(OutputFiles, LeavesNoTraceWhenOnePlaceIsRefused) {
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addDirectory("--png", scratch.path("pictures"));
    outputs.addFile("--csv", scratch.path("a.csv"));
    outputs.addFile("--events", scratch.path("missing/b.jsonl"));
    std::string error;
    EXPECT_FALSE(outputs.open(error));
    EXPECT_EQ(error, "--events " + scratch.path("missing/b.jsonl") + ": cannot be written: No such file or directory");
    EXPECT_TRUE(scratch.isEmpty());
}

TEST(OutputFiles, KeepsOldFilesWhenAnotherPlaceIsRefused) {
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addFile("--csv", scratch.write("a.csv", "precious"));
    outputs.addFile("--report", scratch.path("missing/b.json"));
    std::string error;
    EXPECT_FALSE(outputs.open(error));
    EXPECT_EQ(scratch.read("a.csv"), "precious");
}

TEST(OutputFiles, RefusesADirectoryThatIsAFile) {
    const ScratchDirectory scratch;
    const std::string file = scratch.write("file", "text");
    for (const std::string& path : {file, file + "/below"}) {
        OutputFiles outputs;
        outputs.addDirectory("--png", path);
        std::string error;
        EXPECT_FALSE(outputs.open(error));
        EXPECT_NE(error.find("--png " + path + ": cannot be made a directory"), std::string::npos) << error;
    }
    EXPECT_EQ(scratch.read("file"), "text");
}

TEST(OutputFiles, RefusesStandardOutput) {
    const ScratchDirectory scratch;
    for (const bool isFile : {true, false}) {
        OutputFiles outputs;
        outputs.addFile("--csv", scratch.path("a.csv"));
        isFile ? outputs.addFile("--events", "-") : outputs.addDirectory("--png", "-");
        std::string error;
        EXPECT_FALSE(outputs.open(error));
        EXPECT_NE(error.find(isFile ? "--events -: " : "--png -: "), std::string::npos) << error;
        EXPECT_TRUE(scratch.isEmpty());
        EXPECT_FALSE(std::filesystem::exists("-"));
    }
}

TEST(OutputFiles, AStreamMayBeStandardOutputOnce) {
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addStream("--csv", "-");
    outputs.addStream("--events", scratch.path("events"));
    std::string error;
    ASSERT_TRUE(outputs.open(error)) << error;
    EXPECT_EQ(outputs.stream("-"), &std::cout);
    *outputs.stream(scratch.path("events")) << "something\n";
    outputs.discard();
    EXPECT_FALSE(std::filesystem::exists("-"));
    EXPECT_TRUE(scratch.isEmpty());
    OutputFiles twice;
    twice.addStream("--csv", "-");
    twice.addStream("--events", "-");
    EXPECT_FALSE(twice.open(error));
    EXPECT_EQ(error, "--events -: standard output is that of --csv already; give a name");
}

TEST(OutputFiles, RefusesToOverwriteTheInputOrItself) {
    const ScratchDirectory scratch;
    const std::string input = scratch.write("scene.json", "{}");
    std::string error;
    OutputFiles overInput;
    overInput.protect(input);
    overInput.addFile("--csv", scratch.path("./scene.json"));
    EXPECT_FALSE(overInput.open(error));
    EXPECT_NE(error.find("would overwrite the input"), std::string::npos) << error;
    EXPECT_EQ(scratch.read("scene.json"), "{}");

    OutputFiles twice;
    twice.addFile("--csv", scratch.path("out"));
    twice.addFile("--events", scratch.path("./out"));
    EXPECT_FALSE(twice.open(error));
    EXPECT_NE(error.find("--csv"), std::string::npos) << error;
    EXPECT_FALSE(scratch.has("out"));
}

TEST(OutputFiles, WhatCouldNotBeWrittenLeavesNothingHalfDone) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    const ScratchDirectory scratch;
    OutputFiles outputs;
    outputs.addFile("--csv", scratch.path("new.csv"));
    outputs.addFile("--report", scratch.write("old.json", "of an earlier run"));
    outputs.addFile("--events", "/dev/full");
    std::string error;
    ASSERT_TRUE(outputs.open(error)) << error;
    for (const std::string& path : {scratch.path("new.csv"), scratch.path("old.json"), std::string("/dev/full")}) {
        *outputs.stream(path) << "half of a text";
    }
    EXPECT_FALSE(outputs.close(error));
    EXPECT_EQ(error, "--events /dev/full: could not be written to the end");
    EXPECT_TRUE(scratch.isEmpty());
    EXPECT_TRUE(std::filesystem::exists("/dev/full")) << "a device is not ours to remove";
}

TEST(OutputFiles, RefusesAFileThatADirectoryOfOutputsHolds) {
    const ScratchDirectory scratch;
    const auto isPicture = [](const std::string& name) { return name == "picture.png"; };
    std::string error;
    for (const char* const path : {"pictures/picture.png", "pictures/../pictures/./picture.png"}) {
        OutputFiles outputs;
        outputs.addDirectory("--png", scratch.path("pictures"), isPicture);
        outputs.addFile("--csv", scratch.path(path));
        EXPECT_FALSE(outputs.open(error));
        EXPECT_EQ(error, "--csv " + scratch.path(path) + ": is already a file of --png " + scratch.path("pictures"));
        EXPECT_TRUE(scratch.isEmpty());
    }
    OutputFiles overInput;
    std::filesystem::create_directory(scratch.path("pictures"));
    overInput.protect(scratch.write("pictures/picture.png", "a scene"));
    overInput.addDirectory("--png", scratch.path("pictures"), isPicture);
    EXPECT_FALSE(overInput.open(error));
    EXPECT_NE(error.find("would overwrite the input"), std::string::npos) << error;
    EXPECT_EQ(scratch.read("pictures/picture.png"), "a scene");
    OutputFiles beside;
    beside.addDirectory("--png", scratch.path("pictures"), isPicture);
    beside.addFile("--csv", scratch.path("pictures/states.csv"));
    EXPECT_TRUE(beside.open(error)) << error;
}

/// A long run must not go on when its disk is full.
TEST(OutputFiles, TellThatSomethingCouldNotBeWrittenBeforeTheEnd) {
    OutputFiles outputs;
    outputs.addFile("--csv", "/dev/full");
    std::string error;
    ASSERT_TRUE(outputs.open(error)) << error;
    EXPECT_TRUE(outputs.isWritten(error));
    *outputs.stream("/dev/full") << std::string(1 << 20, 'x');
    EXPECT_FALSE(outputs.isWritten(error));
    EXPECT_EQ(error, "--csv /dev/full: could not be written to the end");
}

/// Whoever reads it would take a pipe that is closed and opened again for ended.
TEST(OutputFiles, PipesAreOpenedOnce) {
    const ScratchDirectory scratch;
    for (int i = 0; i < 50; ++i) {
        const std::string path = scratch.path("pipe" + std::to_string(i));
        ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
        std::string read;
        std::thread reader([&] {
            std::ifstream pipe(path, std::ios::binary);
            read.assign(std::istreambuf_iterator<char>(pipe), {});
        });
        OutputFiles outputs;
        outputs.addFile("--csv", path);
        std::string error;
        const bool isOpen = outputs.open(error);
        if (isOpen) { *outputs.stream(path) << "text"; }
        const bool isClosed = isOpen && outputs.close(error);
        reader.join();
        ASSERT_TRUE(isClosed) << error;
        ASSERT_EQ(read, "text");
    }
}

}  // namespace
}  // namespace swept
