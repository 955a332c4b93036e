#include "server/blobs/blob_store.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/files.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/uploads.h"
#include "tests/service/work_fakes.h"
#include "tests/support/temporary_folder.h"

namespace lambert::server {
namespace {

constexpr char kHello[] = "hello, patches";

std::string Bytes(const std::shared_ptr<const Blob>& blob) { return std::string(blob->bytes()); }

// Every store keeps the same promises.
class AnyBlobStore : public testing::TestWithParam<std::string> {
 protected:
  AnyBlobStore() { Open(); }
  void Open() {
    store_ = GetParam() == "memory" ? MakeMemoryBlobStore(1000)
                                    : *MakeDirectoryBlobStore(folder_.path());
  }
  absl::Status Put(const std::string& bytes) { return store_->Put(Sha256Hex(bytes), bytes); }

  TemporaryFolder folder_;
  std::unique_ptr<BlobStore> store_;
  const std::string digest_ = Sha256Hex(std::string(kHello));
  FakeClock clock_;
};

TEST_P(AnyBlobStore, ReturnsWhatWasPut) {
  ASSERT_TRUE(Put(kHello).ok());
  EXPECT_TRUE(store_->Has(digest_));
  EXPECT_EQ(Bytes(*store_->Get(digest_)), kHello);
}

TEST_P(AnyBlobStore, KeepsAnEmptyBlob) {
  ASSERT_TRUE(Put("").ok());
  EXPECT_EQ(Bytes(*store_->Get(Sha256Hex(std::string()))), "");
}

TEST_P(AnyBlobStore, SaysThatABlobIsNotThere) {
  EXPECT_FALSE(store_->Has(digest_));
  EXPECT_EQ(ReasonOf(store_->Get(digest_).status()), "BLOB_NOT_FOUND");
}

TEST_P(AnyBlobStore, ADeletedBlobStaysReadableForThoseWhoReadIt) {
  ASSERT_TRUE(Put(kHello).ok());
  std::shared_ptr<const Blob> blob = *store_->Get(digest_);
  store_->Delete(digest_);
  EXPECT_FALSE(store_->Has(digest_));
  EXPECT_EQ(Bytes(blob), kHello);
}

TEST_P(AnyBlobStore, AnUploadArrivesInPieces) {
  Uploads uploads(store_.get(), {}, clock_.clock());
  EXPECT_EQ(*uploads.Write(digest_, 14, 0, "hello, "), 7);
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14), 7);
  EXPECT_FALSE(store_->Has(digest_));
  EXPECT_EQ(*uploads.Write(digest_, 14, 7, "patches"), 14);
  EXPECT_EQ(Bytes(*store_->Get(digest_)), kHello);
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14), 14);
}

TEST_P(AnyBlobStore, APieceThatDoesNotFitIsRefusedAndHarmless) {
  Uploads uploads(store_.get(), {}, clock_.clock());
  EXPECT_TRUE(uploads.Write(digest_, 14, 0, "hello, ").ok());
  for (int64_t offset : {0, 6, 8, -1, 14}) {
    EXPECT_EQ(ReasonOf(uploads.Write(digest_, 14, offset, "patches").status()), "OFFSET_MISMATCH");
  }
  EXPECT_EQ(*uploads.Write(digest_, 14, 7, "patches"), 14);
}

TEST_P(AnyBlobStore, OtherBytesThanTheDigestSaysAreRefusedAndForgotten) {
  Uploads uploads(store_.get(), {}, clock_.clock());
  EXPECT_EQ(ReasonOf(uploads.Write(digest_, 14, 0, "hello, pitches").status()), "DIGEST_MISMATCH");
  EXPECT_FALSE(store_->Has(digest_));
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14), 0);
  EXPECT_EQ(*uploads.Write(digest_, 14, 0, kHello), 14);
}

TEST_P(AnyBlobStore, BadNamesAndSizesAreRefused) {
  Uploads uploads(store_.get(), {.blob_bytes = 100}, clock_.clock());
  EXPECT_EQ(ReasonOf(uploads.Write("../../etc/passwd", 1, 0, "x").status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(uploads.CommittedSize("ABC", 1).status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(uploads.Write(digest_, -1, 0, "x").status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(uploads.Write(digest_, 101, 0, "x").status()), "BLOB_TOO_LARGE");
}

TEST_P(AnyBlobStore, AnUploadThatNobodyGoesOnWithIsForgotten) {
  const UploadLimits limits;
  Uploads uploads(store_.get(), limits, clock_.clock());
  EXPECT_TRUE(uploads.Write(digest_, 14, 0, "hello, ").ok());
  clock_.Advance(limits.idle + std::chrono::seconds(1));
  uploads.DropIdle();
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14), 0);
}

TEST_P(AnyBlobStore, TheOldestUploadGivesWayWhereThereAreTooMany) {
  Uploads uploads(store_.get(), {.count = 1}, clock_.clock());
  EXPECT_TRUE(uploads.Write(digest_, 14, 0, "hello, ").ok());
  clock_.Advance(std::chrono::seconds(1));
  EXPECT_TRUE(uploads.Write(Sha256Hex(std::string("other")), 5, 0, "oth").ok());
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14), 0);
}

TEST_P(AnyBlobStore, WhoUploadsMostGivesWay) {
  Uploads uploads(store_.get(), {.count = 2}, clock_.clock());
  EXPECT_TRUE(uploads.Write(digest_, 14, 0, "hello, ", "alice").ok());
  for (const std::string other : {"one", "two", "three"}) {
    clock_.Advance(std::chrono::seconds(1));
    EXPECT_TRUE(uploads.Write(Sha256Hex(other), 7, 0, other, "bob").ok());
  }
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14, "alice"), 7);
  EXPECT_EQ(*uploads.CommittedSize(digest_, 14, "bob"), 0) << "each has its own";
  EXPECT_EQ(uploads.BytesOf("alice"), 7);
}

TEST_P(AnyBlobStore, WhatTwoUploadedStaysUntilNeitherNeedsIt) {
  BlobRefs refs(store_.get(), std::chrono::hours(1), clock_.clock());
  ASSERT_TRUE(Put(kHello).ok());
  refs.NoteUpload(digest_, "alice", 14);
  refs.NoteUpload(digest_, "bob", 14);
  refs.Add(digest_);
  refs.ForgetUpload(digest_, "alice");
  EXPECT_TRUE(refs.UploadsOf("alice").empty());
  refs.Release(digest_);
  EXPECT_TRUE(store_->Has(digest_));
  EXPECT_EQ(refs.UploadsOf("bob").at(digest_), 14);
  refs.ForgetUpload(digest_, "bob");
  EXPECT_FALSE(store_->Has(digest_));
}

TEST_P(AnyBlobStore, ABlobGoesWithItsLastReference) {
  BlobRefs refs(store_.get(), std::chrono::hours(1), clock_.clock());
  ASSERT_TRUE(Put(kHello).ok());
  refs.Add(digest_);
  refs.Add(digest_);
  refs.Release(digest_);
  EXPECT_TRUE(store_->Has(digest_));
  refs.Release(digest_);
  EXPECT_FALSE(store_->Has(digest_));
}

TEST_P(AnyBlobStore, AnUploadedBlobThatNobodyNeedsGoesAfterAWhile) {
  BlobRefs refs(store_.get(), std::chrono::hours(1), clock_.clock());
  ASSERT_TRUE(Put(kHello).ok());
  refs.NoteUpload(digest_, "", 14);
  refs.DropIdle();
  EXPECT_TRUE(store_->Has(digest_));
  clock_.Advance(std::chrono::hours(2));
  refs.DropIdle();
  EXPECT_FALSE(store_->Has(digest_));
}

INSTANTIATE_TEST_SUITE_P(Stores, AnyBlobStore, testing::Values("memory", "directory"),
                         [](const auto& info) { return info.param; });

TEST(MemoryBlobStore, IsFullAtItsLimit) {
  auto store = MakeMemoryBlobStore(10);
  EXPECT_TRUE(store->Put(Sha256Hex(std::string(6, 'a')), std::string(6, 'a')).ok());
  EXPECT_EQ(ReasonOf(store->Put(Sha256Hex(std::string(6, 'b')), std::string(6, 'b'))),
            "STORE_FULL");
  store->Delete(Sha256Hex(std::string(6, 'a')));
  EXPECT_TRUE(store->Put(Sha256Hex(std::string(6, 'b')), std::string(6, 'b')).ok());
}

TEST(DirectoryBlobStore, FindsBlobsAndBrokenUploadsAgain) {
  TemporaryFolder folder;
  FakeClock clock;
  const std::string digest = Sha256Hex(std::string(kHello));
  {
    auto store = *MakeDirectoryBlobStore(folder.path());
    ASSERT_TRUE(store->Put(Sha256Hex(std::string("kept")), "kept").ok());
    Uploads uploads(store.get(), {}, clock.clock());
    ASSERT_TRUE(uploads.Write(digest, 14, 0, "hello, ").ok());
  }
  auto store = *MakeDirectoryBlobStore(folder.path());
  EXPECT_EQ(Bytes(*store->Get(Sha256Hex(std::string("kept")))), "kept");
  Uploads uploads(store.get(), {}, clock.clock());
  EXPECT_EQ(*uploads.CommittedSize(digest, 14), 7);
  EXPECT_EQ(*uploads.Write(digest, 14, 7, "patches"), 14);
  EXPECT_EQ(Bytes(*store->Get(digest)), kHello);
}

TEST(DirectoryBlobStore, NoticesBytesThatHaveChanged) {
  TemporaryFolder folder;
  const std::string digest = Sha256Hex(std::string(kHello));
  ASSERT_TRUE((*MakeDirectoryBlobStore(folder.path()))->Put(digest, kHello).ok());
  std::ofstream(folder.path() + "/blobs/" + digest) << "hello, pitches";
  EXPECT_EQ(ReasonOf((*MakeDirectoryBlobStore(folder.path()))->Get(digest).status()),
            "BLOB_CORRUPT");
}

TEST(WriteFileAtomically, LeavesTheOldFileWhereTheNewOneCannotBeWritten) {
  TemporaryFolder folder;
  const std::string path = folder.path() + "/record";
  ASSERT_TRUE(WriteFileAtomically(path, "old").ok());
  ASSERT_TRUE(WriteFileAtomically(path, "new").ok());
  EXPECT_EQ(*ReadFile(path), "new");
  EXPECT_FALSE(WriteFileAtomically(folder.path() + "/missing/record", "x").ok());
  EXPECT_EQ(*ListFiles(folder.path()), (std::vector<std::string>{"record"}));
}

TEST(FileError, CallsAFullDiskByItsName) {
  EXPECT_EQ(ReasonOf(FileError("/data/blobs/x", ENOSPC)), "STORE_FULL");
  EXPECT_EQ(ReasonOf(FileError("/data/blobs/x", EACCES)), "STORE_FAILED");
}

TEST(ListFiles, RemovesWhatACrashLeftHalfWritten) {
  TemporaryFolder folder;
  std::ofstream(folder.path() + "/record.7.tmp") << "half";
  EXPECT_TRUE(ListFiles(folder.path())->empty());
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/record.7.tmp"));
}

}  // namespace
}  // namespace lambert::server
