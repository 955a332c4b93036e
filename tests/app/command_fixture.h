// A folder with a scene in it, and the `lambert` command to run there.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/support/process.h"
#include "tests/support/scenes.h"

namespace lambert::app {

struct Ran {
  int exit_code;
  std::string output, error;
};

class CommandFixture : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("lambert_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    Write("room.glb", ToGlb(MakeCornell(2)));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Starts `lambert ARGUMENTS...` in the folder.
  std::unique_ptr<Process> Start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LAMBERT_COMMAND);
    return std::make_unique<Process>(arguments, Here());
  }
  Ran Run(const std::vector<std::string>& arguments) {
    const auto process = Start(arguments);
    const int exit_code = process->Wait();
    return {exit_code, process->output(), process->error()};
  }

  ProcessOptions Here() const { return {folder_.string(), environment_}; }
  void Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Every file that an output folder has to hold.
  void ExpectAllFiles(const std::string& out, const std::string& name = "room") const {
    for (const std::string& file :
         {std::string("patches.csv"), std::string("convergence.csv"), std::string("run.json"),
          std::string("report.html"), name + ".glb", name + ".exr", name + ".png"}) {
      EXPECT_GT(Read(out + "/" + file).size(), 100u) << file;
    }
  }

  std::filesystem::path folder_;
  std::map<std::string, std::string> environment_;
};

}  // namespace lambert::app
