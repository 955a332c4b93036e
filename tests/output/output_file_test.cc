#include "radiosity/output/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "radiosity/core/error.h"
#include "tests/output/known_light.h"
#include "tests/support/read_file.h"

namespace lambert {
namespace {

TEST(OutputFile, AppearsWholeWhenCommitted) {
  const std::string path = TestFolder() + "/a.txt";
  absl::StatusOr<OutputFile> file = OutputFile::Create(path);
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(file->Append("one ").ok());
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(file->Append("two").ok());
  ASSERT_TRUE(file->Commit().ok());
  EXPECT_EQ(ReadFile(path), "one two");
}

TEST(OutputFile, LeavesNothingBehindWhenDropped) {
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputFile(folder + "/a.txt", "old").ok());
  {
    absl::StatusOr<OutputFile> file = OutputFile::Create(folder + "/a.txt");
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file->Append("half of the n").ok());
  }
  EXPECT_EQ(ReadFile(folder + "/a.txt"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(OutputFile, AFullDiskSaysWhereWhatAndWhatToDo) {
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  const absl::Status status = WriteAll(full, "out/patches.csv", "bytes");
  close(full);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(status.message(),
            "out/patches.csv: cannot be written (No space left on device); free some space or "
            "choose another folder with -o");
  EXPECT_EQ(ReasonOf(status), "OUTPUT_FAILED");
}

TEST(OutputFile, AMissingFolderIsAnErrorThatNamesTheFile) {
  const std::string path = TestFolder() + "/missing/a.txt";
  const absl::Status status = WriteOutputFile(path, "x");
  EXPECT_EQ(GetErrorDetail(status)->where, path);
}

TEST(OutputFolder, IsMadeWithTheFoldersAboveIt) {
  const std::string folder = TestFolder() + "/a/b";
  EXPECT_TRUE(MakeOutputFolder(folder).ok());
  EXPECT_TRUE(MakeOutputFolder(folder).ok());
  EXPECT_TRUE(std::filesystem::is_directory(folder));
}

TEST(OutputFolder, AFileInItsPlaceIsRefused) {
  const std::string path = TestFolder() + "/file";
  ASSERT_TRUE(WriteOutputFile(path, "x").ok());
  const absl::Status status = MakeOutputFolder(path);
  EXPECT_EQ(ReasonOf(status), "OUTPUT_FAILED");
  EXPECT_EQ(GetErrorDetail(status)->where, path);
}

}  // namespace
}  // namespace lambert
