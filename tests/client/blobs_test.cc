#include "client/blobs.h"

#include <map>

#include "gtest/gtest.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "tests/client/fake_server.h"

namespace lambert::client {
namespace {

// Keeps blobs, and breaks every stream off after `break_after` messages, `breaks` times.
class FakeBlobs : public v1::BlobService::Service {
 public:
  grpc::Status FindMissingBlobs(grpc::ServerContext*, const v1::FindMissingBlobsRequest* request,
                                v1::FindMissingBlobsResponse* response) override {
    for (const v1::Digest& digest : request->digests()) {
      if (blobs.count(digest.sha256()) == 0) *response->add_missing_digests() = digest;
    }
    return grpc::Status::OK;
  }
  grpc::Status GetBlobUpload(grpc::ServerContext*, const v1::GetBlobUploadRequest* request,
                             v1::BlobUpload* response) override {
    response->set_committed_size_bytes(blobs[request->digest().sha256()].size());
    return grpc::Status::OK;
  }
  grpc::Status UploadBlob(grpc::ServerContext*, grpc::ServerReader<v1::UploadBlobRequest>* reader,
                          v1::UploadBlobResponse* response) override {
    v1::UploadBlobRequest request;
    std::string sha256;
    for (int message = 0; reader->Read(&request); ++message) {
      if (message == 0) sha256 = request.digest().sha256();
      std::string& bytes = blobs[sha256];
      if (request.offset_bytes() != static_cast<int64_t>(bytes.size())) {
        return {grpc::StatusCode::INVALID_ARGUMENT, "wrong offset"};
      }
      if (request.data().size() > 1 << 20) return {grpc::StatusCode::INVALID_ARGUMENT, "too big"};
      bytes += request.data();
      if (message + 1 == break_after && breaks-- > 0) {
        return {grpc::StatusCode::UNAVAILABLE, "broken"};
      }
    }
    return grpc::Status::OK;
  }
  grpc::Status DownloadBlob(grpc::ServerContext*, const v1::DownloadBlobRequest* request,
                            grpc::ServerWriter<v1::DownloadBlobResponse>* writer) override {
    const std::string& bytes = blobs[request->sha256()];
    int message = 0;
    for (size_t offset = request->offset_bytes(); offset < bytes.size(); offset += 1000) {
      v1::DownloadBlobResponse response;
      response.set_data(bytes.substr(offset, 1000));
      writer->Write(response);
      if (++message == break_after && breaks-- > 0) {
        return {grpc::StatusCode::UNAVAILABLE, "broken"};
      }
    }
    return grpc::Status::OK;
  }

  std::map<std::string, std::string> blobs;
  int break_after = 2;
  int breaks = 0;
};

class BlobsTest : public testing::Test {
 protected:
  FakeBlobs fake_;
  FakeServer server_{&fake_};
  NotedCaller noted_;
  std::unique_ptr<v1::BlobService::Stub> stub_ = v1::BlobService::NewStub(server_.channel());
  Blobs blobs_{stub_.get(), &noted_.caller};
};

std::string Bytes(size_t count) {
  std::string bytes(count, '\0');
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<char>(i * 2654435761u >> 13);
  return bytes;
}

TEST_F(BlobsTest, WhatTheServerLacksIsSentInChunksAndOnlyOnce) {
  const std::string big = Bytes((5 << 20) / 2), small = "abc", empty;
  std::vector<int64_t> done;
  const auto progress = [&](int64_t bytes, int64_t total) {
    EXPECT_EQ(total, static_cast<int64_t>(big.size() + small.size()));
    done.push_back(bytes);
  };
  ASSERT_TRUE(blobs_.Upload({&big, &small, &big, &empty}, progress).ok());
  EXPECT_EQ(fake_.blobs.at(Sha256Hex(big)), big);
  EXPECT_EQ(fake_.blobs.at(Sha256Hex(small)), small);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  const size_t calls = done.size();
  ASSERT_TRUE(blobs_.Upload({&big, &small}, progress).ok());
  EXPECT_EQ(done.size(), calls + 1);  // nothing was sent: told once that all is there
}

TEST_F(BlobsTest, ABrokenUploadGoesOnWhereItBroke) {
  const std::string big = Bytes(5 << 20);
  fake_.breaks = 2;
  ASSERT_TRUE(blobs_.Upload({&big}, [](int64_t, int64_t) {}).ok());
  EXPECT_EQ(fake_.blobs.at(Sha256Hex(big)), big);
  EXPECT_LT(fake_.breaks, 1);
}

TEST_F(BlobsTest, ABrokenDownloadGoesOnFromItsNextByte) {
  const std::string big = Bytes(10'500);
  fake_.blobs[Sha256Hex(big)] = big;
  fake_.breaks = 3;
  const auto bytes = blobs_.Download({Sha256Hex(big), 10'500}, "patch set");
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  EXPECT_EQ(*bytes, big);
}

TEST_F(BlobsTest, BytesThatAreNotThoseThatWereNamedAreRefused) {
  const std::string right = Bytes(3000);
  for (const std::string& wrong : {Bytes(2999) + 'x', Bytes(2999), Bytes(5'000'000)}) {
    fake_.blobs[Sha256Hex(right)] = wrong;
    const absl::Status status = blobs_.Download({Sha256Hex(right), 3000}, "solution").status();
    EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
    EXPECT_EQ(ReasonOf(status), "BLOB_CORRUPT");
  }
}

}  // namespace
}  // namespace lambert::client
