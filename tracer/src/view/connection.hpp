// A connection to an untrusted client. Waiting is limited by a deadline, and reading by a maximum size. cpp-httplib
// only sees complete request heads.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace phasetree::tracer::view {

// cpp-httplib's virtual functions differ between versions, so some functions that override them are not marked
// `override`.
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Winconsistent-missing-override"
#endif

class Connection : public httplib::Stream {
  public:
    static constexpr std::size_t most_bytes_of_head = 16 * 1024;
    static constexpr std::size_t most_bytes_of_body = 8 * 1024 * 1024;  ///< for the text of a scene
    static constexpr std::chrono::milliseconds request_timeout{3000};
    static constexpr std::chrono::milliseconds answer_timeout{10000};

    /// Takes ownership of the socket, which the destructor closes.
    explicit Connection(int socket);
    ~Connection() override;
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Reads up to the empty line that ends a request's head. Returns whether it arrived in time and is not too large.
    bool read_head();
    /// Sends an answer without using the library.
    void refuse(std::string_view status);

    // The library calls the first two before 0.19 and the others from then on, so none can be marked `override`.
    bool is_readable() const { return true; }
    bool is_writable() const { return true; }
    bool wait_readable() const { return true; }
    bool wait_writable() const { return true; }
    time_t duration() const { return 0; }

    ssize_t read(char* to, std::size_t size) override;
    ssize_t write(const char* from, std::size_t size) override;
    void get_remote_ip_and_port(std::string& ip, int& port) const override;
    void get_local_ip_and_port(std::string& ip, int& port) const override;
    socket_t socket() const override { return socket_; }

  private:
    using Clock = std::chrono::steady_clock;

    bool wait(short events) const;
    ssize_t receive(char* to, std::size_t size);

    int socket_;
    std::string head_;          ///< and data that arrived with it
    std::size_t given_ = 0;     ///< bytes of it passed to the library
    std::size_t received_ = 0;  ///< in total
    Clock::time_point deadline_ = Clock::now() + request_timeout;
    bool is_answering_ = false;
};

#ifdef __clang__
#pragma clang diagnostic pop
#endif

}  // namespace phasetree::tracer::view
