// One page of an HTTP server on this machine, for tests.
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace lambert {

// The whole answer of `address` (127.0.0.1:PORT) to GET `path`: status line, headers, body; ""
// where nobody answers.
inline std::string HttpGet(const std::string& address, const std::string& path) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (connect(connection, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0) {
    const std::string request =
        "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    if (write(connection, request.data(), request.size()) > 0) {
      char piece[4096];
      for (ssize_t size; (size = read(connection, piece, sizeof(piece))) > 0;) {
        answer.append(piece, static_cast<size_t>(size));
      }
    }
  }
  close(connection);
  return answer;
}

}  // namespace lambert
