// A folder with a scene in it, and the `lambert` command to run there.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/support/process.h"
#include "tests/support/read_file.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace lambert::app {

struct Ran {
  int exit_code;
  std::string output, error;
};

class CommandFixture : public testing::Test {
 protected:
  void SetUp() override { Write("room.glb", ToGlb(MakeCornell(2))); }

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
  std::string Read(const std::string& name) const { return ReadFile(folder_ / name); }
  // Every file that an output folder has to hold.
  void ExpectAllFiles(const std::string& out, const std::string& name = "room") const {
    for (const std::string& file :
         {std::string("patches.csv"), std::string("convergence.csv"), std::string("run.json"),
          std::string("report.html"), name + ".glb", name + ".exr", name + ".png"}) {
      EXPECT_GT(Read(out + "/" + file).size(), 100u) << file;
    }
  }

  const TemporaryFolder own_;
  const std::filesystem::path folder_ = own_.path();
  std::map<std::string, std::string> environment_;
};

}  // namespace lambert::app
