#include "view/server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <charconv>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "output/encode.hpp"
#include "output/error.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"
#include "view/access.hpp"
#include "view/connection.hpp"
#include "view/freed_memory.hpp"
#include "view/grab.hpp"
#include "view/page_files.hpp"
#include "view/requests.hpp"
#include "view/studio_answers.hpp"
#include "view/workers.hpp"

namespace phasetree::tracer::view {

namespace {

// How long a request waits for the next picture, and how many requests may wait. Others get the current state at once.
constexpr std::chrono::milliseconds longest_wait{5000};
constexpr int most_waiting = 8;

constexpr const char* plain = "text/plain; charset=utf-8";
constexpr const char* json = "application/json";

// The names that accept POST, in addition to the studio's.
constexpr std::string_view posted[] = {"change", "ask", "write", "write_numbers"};
// What is posted only if the scene is in a file.
constexpr std::string_view posted_for_files[] = {"grab", "drag", "selected"};
constexpr std::uint64_t most_bytes_of_small_body = 64 * 1024;

std::string type_of(std::string_view file) {
    if (file.ends_with(".js")) return "text/javascript; charset=utf-8";
    if (file.ends_with(".css")) return "text/css; charset=utf-8";
    return "text/html; charset=utf-8";
}

// A whole number; 0 for any other text.
std::uint64_t whole_number(const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

std::uint64_t number(const httplib::Request& request, const char* name) {
    return whole_number(request.get_param_value(name));
}

std::uint64_t length_of_body(const httplib::Request& request) {
    return whole_number(request.get_header_value("Content-Length"));
}

// cpp-httplib with our own connections.
class Server : public httplib::Server {
  public:
    /// Ends all connections.
    void end_connections() {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
        for (const int socket : open_) ::shutdown(socket, SHUT_RDWR);
    }

  private:
    // One request per connection, so that the unread rest of one is never mistaken for another.
    bool process_and_close_socket(socket_t socket) override {
        Connection connection(socket);
        if (Workers::is_refusing()) {
            connection.refuse("503 Service Unavailable");
            return false;
        }
        {
            const std::lock_guard lock(mutex_);
            if (is_over_) return false;
            open_.insert(socket);
        }
        bool is_closed = false;
        bool is_answered = false;
        if (connection.read_head())
            is_answered = answer(*this, connection, is_closed);
        else
            connection.refuse("408 Request Timeout");
        const std::lock_guard lock(mutex_);
        open_.erase(socket);
        return is_answered;
    }

    // From 0.15 on, the library asks for the addresses, which are not used here.
    template <class Self>
    static bool answer(Self& self, Connection& connection, bool& is_closed) {
        if constexpr (requires { self.process_request(connection, true, is_closed, {}); })
            return self.process_request(connection, true, is_closed, {});
        else
            return self.process_request(connection, "127.0.0.1", 0, "127.0.0.1", 0, true, is_closed, {});
    }

    std::mutex mutex_;
    std::set<int> open_;
    bool is_over_ = false;
};

class Answers {
  public:
    Answers(Session& session, studio::EditedDocument* document, Access access, bool may_be_framed)
        : session_(session), access_(std::move(access)), may_be_framed_(may_be_framed) {
        if (!document) return;
        studio_.emplace(*document);
        grabs_ = std::make_unique<Grabs>(*document);
    }

    // Called before the body is read. Returns whether the request has already been answered.
    bool head(const httplib::Request& request, httplib::Response& response) const {
        set_headers(response);
        if (!access_.allows(request.get_header_value("Host"), request.get_header_value("Origin"), request.path))
            return refuse(response, 403, "forbidden: open the address that phasetree view printed");
        const std::string_view name = access_.within(request.path);
        if (request.method == "GET") {
            if (!get(name, request, response)) return refuse(response, 404, "no such page");
            return true;
        }
        if (request.method != "POST") return refuse(response, 405, "only GET and POST are supported");
        if (!is_posted(name)) return refuse(response, 404, "no such page");
        if (request.has_header("Content-Encoding") || request.has_header("Transfer-Encoding") ||
            !request.has_header("Content-Length"))
            return refuse(response, 411, "a request must be unencoded and have a Content-Length");
        if (request.get_header_value("Content-Type") != json)
            return refuse(response, 415, "a request must have the type application/json");
        if (name != "document" && length_of_body(request) > most_bytes_of_small_body)
            return refuse(response, 413, "the request is too large");
        return false;
    }
    void post(const httplib::Request& request, httplib::Response& response) const {
        const std::string_view name = access_.within(request.path);
        if (StudioAnswers::is_posted(name)) return studio_->post(name, request.body, response);
        try {
            const std::shared_ptr<const Shown> shown = session_.shown();
            if (name == "change") {
                const std::uint64_t version = session_.change(read_change(request.body, *shown));
                response.set_content(fmt::format("{{\"version\": {}}}", version), json);
            } else if (name == "write") {
                session_.write_camera();
                response.set_content("{}", json);
            } else if (name == "write_numbers") {
                session_.write_numbers();
                response.set_content("{}", json);
            } else if (name == "grab") {
                response.set_content(grabs_->grab(request.body, *shown), json);
            } else if (name == "drag") {
                response.set_content(grabs_->drag(request.body, *shown), json);
            } else if (name == "selected" && shown->picture) {
                response.set_content(written(selection_mask(*shown->picture, read_selected(request.body))), json);
            } else if (shown->picture) {
                const glm::vec2 place = read_place(request.body, *shown);
                response.set_content(written(probe(*shown->picture, place)), json);
            } else {
                refuse(response, 409, "there is no picture yet");
            }
        } catch (const SceneError& e) {
            refuse(response, 400, e.what());
        } catch (const ModelError& e) {
            // Finding the selection took too long, which is not an error.
            if (name == "selected") return response.set_content("null", json);
            refuse(response, 409, e.what());
        } catch (const OutputError& e) {
            refuse(response, 409, e.what());
        }
    }
    static bool refuse(httplib::Response& response, int status, const std::string& reason) {
        response.status = status;
        response.set_content(reason + "\n", plain);
        return true;
    }

  private:
    bool is_posted(std::string_view name) const {
        if (std::ranges::find(posted, name) != std::end(posted)) return true;
        return studio_ && (StudioAnswers::is_posted(name) ||
                           std::ranges::find(posted_for_files, name) != std::end(posted_for_files));
    }
    // The page may not load anything from elsewhere or be shown in a foreign frame, and its address is not passed on.
    void set_headers(httplib::Response& response) const {
        response.set_header(
            "Content-Security-Policy",
            fmt::format("default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
                        "connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors {}",
                        may_be_framed_ ? "http://127.0.0.1:* http://localhost:*" : "'none'"));
        response.set_header("Referrer-Policy", "no-referrer");
        response.set_header("X-Content-Type-Options", "nosniff");
        response.set_header("Cross-Origin-Resource-Policy", "same-origin");
        response.set_header("Cache-Control", "no-store");
    }
    bool get(std::string_view name, const httplib::Request& request, httplib::Response& response) const {
        if (name == "picture") return picture(request, response);
        if (studio_ && StudioAnswers::is_answered(name)) {
            const bool may_wait = waiting_.fetch_add(1) < most_waiting;
            const bool is_answered = studio_->get(name, {number(request, "after"), number(request, "text")},
                                                  may_wait ? longest_wait : std::chrono::milliseconds(0), response);
            --waiting_;
            return is_answered;
        }
        if (studio_ && name == "files") {
            studio_->files(request.get_param_value("type"), request.get_param_value("kind"), response);
            return true;
        }
        if (name == "numbers") {
            const std::shared_ptr<const Shown> shown = session_.shown();
            response.set_content(written(*shown->numbers_of_file, shown->numbers_version), json);
            return true;
        }
        if (name == "picture.png") return file(response, Format::png, "image/png");
        if (name == "picture.exr") return file(response, Format::exr, "image/x-exr");
        for (const PageFile& f : page_files())
            if (f.name == (name.empty() ? "index.html" : name)) {
                response.set_content(std::string(f.text), type_of(f.name));
                return true;
            }
        return false;
    }
    // Sends the state after a version as a line of JSON, followed by the picture's pixels if the client does not have
    // them yet.
    bool picture(const httplib::Request& request, httplib::Response& response) const {
        const bool may_wait = waiting_.fetch_add(1) < most_waiting;
        const std::shared_ptr<const Shown> shown =
            session_.shown_after(number(request, "after"), may_wait ? longest_wait : std::chrono::milliseconds(0));
        --waiting_;
        std::string body = written(*shown) + "\n";
        if (shown->picture && shown->picture->number != number(request, "picture"))
            body.append(reinterpret_cast<const char*>(shown->picture->pixels.data()), shown->picture->pixels.size());
        response.set_content(std::move(body), "application/octet-stream");
        return true;
    }
    bool file(httplib::Response& response, Format format, const char* type) const {
        const std::shared_ptr<const Shown> shown = session_.shown();
        if (!shown->picture) return refuse(response, 409, "there is no picture yet");
        const Picture& p = *shown->picture;
        const Metadata metadata{shown->scene, p.samples, p.viewed->scene.settings.seed};
        const std::vector<unsigned char> bytes =
            format == Format::png && !p.layer.empty()
                ? encode_png(p.pixels, p.linear.width, p.linear.height, fmt::format("{}, {}", shown->scene, p.layer))
                : encode(p.linear, format, metadata, p.viewed->display(p.exposure_ev));
        response.set_content(std::string(bytes.begin(), bytes.end()), type);
        return true;
    }

    Session& session_;
    std::optional<StudioAnswers> studio_;
    std::unique_ptr<Grabs> grabs_;
    Access access_;
    bool may_be_framed_;
    mutable std::atomic<int> waiting_{0};
};

}  // namespace

void require_server() {}

std::string server_library() {
    return "cpp-httplib " CPPHTTPLIB_VERSION;
}

void serve(Session& session, const ServeOptions& options) {
    Server server;
    server.new_task_queue = [] { return new Workers; };
    server.set_payload_max_length(Connection::most_bytes_of_body);
    server.set_tcp_nodelay(true);
    // Replaces the library's SO_REUSEPORT, which would let another program receive some of the requests.
    server.set_socket_options([](socket_t socket) {
        const int yes = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    int port = options.port;
    if (port == 0)
        port = server.bind_to_any_port("127.0.0.1");
    else if (!server.bind_to_port("127.0.0.1", port))
        port = -1;
    if (port < 0)
        throw std::runtime_error(fmt::format("port {} of 127.0.0.1 is unavailable; choose another one", options.port));

    const Access access(port, random_token());
    const Answers answers(session, options.document, access, options.may_be_framed);
    using Handled = httplib::Server::HandlerResponse;
    server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
        return answers.head(request, response) ? Handled::Handled : Handled::Unhandled;
    });
    const auto post = [&](const httplib::Request& request, httplib::Response& response) {
        answers.post(request, response);
    };
    for (const std::string_view name : posted) server.Post(access.path() + std::string(name), post);
    for (const std::string_view name : posted_for_files) server.Post(access.path() + std::string(name), post);
    for (const std::string_view name : StudioAnswers::posted) server.Post(access.path() + std::string(name), post);
    server.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
        Answers::refuse(response, 500, "cannot answer the request: memory may have run out");
    });
    std::atomic<bool> has_ended{false};
    std::thread listening([&] {
        server.listen_after_bind();
        has_ended = true;
    });
    options.serving(access.url());
    FreedMemory freed;
    while (!options.is_over()) {
        freed.poll(session.shown()->version);
        session.look_at_files();
        if (options.document) options.document->poll_file();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    session.stop();
    if (options.document) options.document->stop();
    // Before the thread listens, stop() does nothing, and join() would wait forever.
    while (!server.is_running() && !has_ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server.stop();
    server.end_connections();
    listening.join();
}

}  // namespace phasetree::tracer::view
