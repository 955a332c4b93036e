// A server that anybody may talk to, and does: 10,000 requests that are none. It answers each or
// ends its connection, and then solves a job as before.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/distributed/farm.h"
#include "tests/service/raw_call.h"
#include "tests/service/rpc_methods.h"

namespace lambert {
namespace {

constexpr int kRandomBodies = 4000, kWrongMethods = 2000, kBrokenStreams = 3000, kHalfOpen = 200;
constexpr int kOversized = 50, kLongHeaders = 750;
static_assert(kRandomBodies + kWrongMethods + kBrokenStreams + kHalfOpen + kOversized +
                  kLongHeaders ==
              10'000);

class Attacker {
 public:
  explicit Attacker(std::string address) : address_(std::move(address)) {}

  std::string Bytes(size_t size) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random_());
    return bytes;
  }
  size_t Below(size_t n) { return random_() % n; }

  // A call with one message; what becomes of it.
  grpc::StatusCode Call(const std::string& method, const std::string& body,
                        const std::string& metadata = "") {
    // A body may happen to be a good request that is held.
    return CallRaw(stub_, method, body, metadata, std::chrono::seconds(10)).error_code();
  }

  // A connection on which these bytes are sent; the caller closes it.
  int Send(const std::string& bytes) const {
    const size_t colon = address_.rfind(':');
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(std::stoi(address_.substr(colon + 1))));
    inet_pton(AF_INET, address_.substr(0, colon).c_str(), &address.sin_addr);
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(connect(file, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    (void)send(file, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return file;
  }

 private:
  // Shares no connection with others: the server may well end this one.
  static std::shared_ptr<grpc::Channel> MakeChannel(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  }

  const std::string address_;
  std::mt19937_64 random_{7};
  grpc::GenericStub stub_{MakeChannel(address_)};
};

// What begins an HTTP/2 connection: the preface and empty settings.
const std::string kPreface =
    "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + std::string("\0\0\0\4\0\0\0\0\0", 9);

// The most memory that a process ever had [bytes].
int64_t PeakMemory(pid_t id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string word; status >> word;) {
    int64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib << 10;
  }
  return 0;
}

TEST(Attack, TenThousandMalformedRequestsLeaveTheServerAsItWas) {
  Farm farm;
  farm.AddWorker();
  const std::string expected = farm.Watch(farm.CreateJob(20'000, "before").name()).payload;
  const int64_t memory_before = PeakMemory(farm.server().id());
  Attacker attacker(farm.address());

  std::vector<int> half_open;
  for (int i = 0; i < kHalfOpen; ++i) {
    half_open.push_back(attacker.Send(kPreface.substr(0, attacker.Below(kPreface.size() + 1))));
  }
  const auto methods = AllRpcMethods();
  for (int i = 0; i < kRandomBodies; ++i) {
    const auto code = attacker.Call(PathOf(*methods[attacker.Below(methods.size())]),
                                    attacker.Bytes(attacker.Below(300)));
    EXPECT_NE(code, grpc::StatusCode::UNAVAILABLE) << i;
  }
  for (int i = 0; i < kWrongMethods; ++i) {
    std::string method = "/lambert.v1.";
    for (size_t n = attacker.Below(80); n > 0; --n) method += "abc./%"[attacker.Below(6)];
    EXPECT_EQ(attacker.Call(method, "x"), grpc::StatusCode::UNIMPLEMENTED) << method;
  }
  for (int i = 0; i < kOversized; ++i) {
    EXPECT_EQ(attacker.Call("/lambert.v1.BlobService/FindMissingBlobs", std::string(5 << 20, 'x')),
              grpc::StatusCode::RESOURCE_EXHAUSTED);
  }
  for (int i = 0; i < kLongHeaders; ++i) {
    EXPECT_NE(attacker.Call("/lambert.v1.SceneService/ListScenes", "", std::string(12'000, 'x')),
              grpc::StatusCode::OK);
  }
  for (int i = 0; i < kBrokenStreams; ++i) {
    const std::string noise = attacker.Bytes(attacker.Below(200));
    // Noise, noise behind a good beginning, and a frame that says more than it brings.
    const std::string streams[] = {noise, kPreface + noise,
                                   kPreface + std::string("\0\xff\xff\1\4\0\0\0\1", 9) + noise};
    close(attacker.Send(streams[attacker.Below(3)]));
  }
  for (const int file : half_open) close(file);

  const auto after = farm.Watch(farm.CreateJob(20'000, "after").name());
  EXPECT_EQ(after.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(after.payload, expected);
  EXPECT_LT(PeakMemory(farm.server().id()) - memory_before, 256 << 20);
  farm.server().Signal(SIGTERM);
  EXPECT_EQ(farm.server().Wait(), 0);
}

}  // namespace
}  // namespace lambert
