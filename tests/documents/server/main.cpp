// Runs `phasetree` for scripts, in forked children: executing the program spends a quarter of a second in the dynamic
// loader, because Debian's OpenImageIO depends on 200 libraries. forked.py is the client.
//
//     test-command-server SOCKET
//
// A request consists of the client's three standard streams, a number of bytes, and these bytes: NUL-terminated strings
// with the working folder, the number of arguments, the arguments, and the environment variables. The answer is the
// status that wait() returns. The server exits when its standard input ends.
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include "command/run_command.hpp"

namespace {

using Streams = std::array<int, 3>;

// Receives the streams and the number of bytes that follow.
bool receive_start(int client, std::uint32_t& size, Streams& streams) {
    iovec bytes{&size, sizeof size};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Streams))> control{};
    msghdr message{};
    message.msg_iov = &bytes;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (::recvmsg(client, &message, MSG_WAITALL) != sizeof size) return false;
    const cmsghdr* const sent = CMSG_FIRSTHDR(&message);
    if (!sent || sent->cmsg_type != SCM_RIGHTS || sent->cmsg_len != CMSG_LEN(sizeof streams)) return false;
    std::memcpy(streams.data(), CMSG_DATA(sent), sizeof streams);
    return true;
}

[[noreturn]] void run(const Streams& streams, std::vector<std::string> texts) {
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
    for (int i = 0; i < 3; ++i) ::dup2(streams[static_cast<std::size_t>(i)], i);
    const auto count = static_cast<std::size_t>(std::atoi(texts[1].c_str()));
    if (::chdir(texts[0].c_str()) != 0 || texts.size() < 2 + count) ::_exit(127);
    std::vector<char*> words;
    for (std::size_t i = 0; i < count; ++i) words.push_back(texts[2 + i].data());
    words.push_back(nullptr);
    ::clearenv();
    for (std::size_t i = 2 + count; i < texts.size(); ++i) ::putenv(texts[i].data());
    const int code = phasetree::tracer::run_command(static_cast<int>(count), words.data());
    std::cout.flush();
    std::fflush(nullptr);
    ::_exit(code);  // skips destructors of libraries, which join their threads
}

// Serves one client, in its own child process, so that several clients are served at the same time.
[[noreturn]] void serve(int client) {
    std::uint32_t size = 0;
    Streams streams{};
    std::string bytes;
    if (!receive_start(client, size, streams)) ::_exit(1);
    bytes.resize(size);
    if (::recv(client, bytes.data(), size, MSG_WAITALL) != static_cast<ssize_t>(size)) ::_exit(1);
    std::vector<std::string> texts;
    for (std::size_t at = 0; at < bytes.size(); at += texts.back().size() + 1) texts.emplace_back(bytes.c_str() + at);
    if (texts.size() < 2) ::_exit(1);
    const pid_t command = ::fork();
    if (command == 0) run(streams, std::move(texts));
    int status = 0;
    ::waitpid(command, &status, 0);
    ::_exit(::write(client, &status, sizeof status) == sizeof status ? 0 : 1);
}

}  // namespace

int main(int argc, char** argv) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (argc != 2 || std::strlen(argv[1]) >= sizeof address.sun_path) return 2;
    std::strcpy(address.sun_path, argv[1]);
    const int listening = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listening, 64) != 0) {
        std::perror(argv[1]);
        return 1;
    }
    std::puts("ready");
    std::fflush(stdout);
    for (;;) {
        std::array<pollfd, 2> waiting{{{listening, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}}};
        if (::poll(waiting.data(), waiting.size(), -1) < 0) return 1;
        // Reaps children, so that the server's processor time includes that of all commands that it ran.
        while (::waitpid(-1, nullptr, WNOHANG) > 0) continue;
        if (waiting[1].revents != 0) return 0;
        const int client = ::accept(listening, nullptr, nullptr);
        if (client < 0) continue;
        if (::fork() == 0) serve(client);
        ::close(client);
    }
}
