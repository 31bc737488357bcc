#include "view/connection.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace phasetree::tracer::view {

namespace {

constexpr std::string_view end_of_head = "\r\n\r\n";

// Removes a header, whose name is given in lower case.
void drop_header(std::string& head, std::size_t end, std::string_view name) {
    for (std::size_t from = 0; (from = head.find("\r\n", from)) < end; from += 2) {
        const auto is_same = [](char a, char b) { return a == (b | 0x20) || a == b; };
        if (head.size() - from - 2 < name.size() ||
            !std::equal(name.begin(), name.end(), head.begin() + static_cast<std::ptrdiff_t>(from + 2), is_same))
            continue;
        // Keep the length, and change the name to a meaningless one.
        head[from + 2] = 'x';
    }
}

}  // namespace

Connection::Connection(int socket) : socket_(socket) {}

// Read what has arrived, because unread data would make the system discard the answer.
Connection::~Connection() {
    ::shutdown(socket_, SHUT_WR);
    std::array<char, 4096> unread;
    for (int i = 0; i < 32 && ::recv(socket_, unread.data(), unread.size(), MSG_DONTWAIT) > 0; ++i) {
    }
    ::close(socket_);
}

bool Connection::wait(short events) const {
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
        if (left <= 0) return false;
        pollfd waiting{socket_, events, 0};
        const int ready = ::poll(&waiting, 1, static_cast<int>(left));
        if (ready > 0) return true;
        if (ready == 0 || errno != EINTR) return false;
    }
}

ssize_t Connection::receive(char* to, std::size_t size) {
    const std::size_t most = most_bytes_of_head + most_bytes_of_body;
    if (received_ >= most || !wait(POLLIN)) return -1;
    const ssize_t got = ::recv(socket_, to, std::min(size, most - received_), MSG_DONTWAIT);
    if (got > 0) received_ += static_cast<std::size_t>(got);
    return got;
}

bool Connection::read_head() {
    std::array<char, 4096> part;
    while (head_.find(end_of_head) == std::string::npos) {
        if (head_.size() > most_bytes_of_head) return false;
        const ssize_t got = receive(part.data(), part.size());
        if (got <= 0) return false;
        head_.append(part.data(), static_cast<std::size_t>(got));
    }
    const std::size_t end = head_.find(end_of_head);
    if (end > most_bytes_of_head) return false;
    // Partial pictures are not supported, because one request could ask for thousands of parts.
    drop_header(head_, end, "range:");
    // Nothing is compressed: cpp-httplib uses Brotli at its slowest level, which takes longer than the answer itself.
    drop_header(head_, end, "accept-encoding:");
    return true;
}

void Connection::refuse(std::string_view status) {
    const std::string answer = fmt::format("HTTP/1.1 {}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n", status);
    (void)::send(socket_, answer.data(), answer.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

ssize_t Connection::read(char* to, std::size_t size) {
    if (given_ == head_.size()) return receive(to, size);
    const std::size_t part = std::min(size, head_.size() - given_);
    std::copy_n(head_.data() + given_, part, to);
    given_ += part;
    return static_cast<ssize_t>(part);
}

ssize_t Connection::write(const char* from, std::size_t size) {
    if (!std::exchange(is_answering_, true)) deadline_ = Clock::now() + answer_timeout;
    if (!wait(POLLOUT)) return -1;
    const ssize_t sent = ::send(socket_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    return sent < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : sent;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
    ip = "127.0.0.1";
    port = 0;
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
    get_remote_ip_and_port(ip, port);
}

}  // namespace phasetree::tracer::view
