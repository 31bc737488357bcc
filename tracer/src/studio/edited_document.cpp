#include "studio/edited_document.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "output/error.hpp"
#include "output/file.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "studio/rebase.hpp"

namespace phasetree::tracer::studio {

namespace {

constexpr std::size_t max_recent_texts = 64;
constexpr std::size_t max_recent_bytes = std::size_t{64} << 20;
constexpr const char* label_of_outside = "Change made in another program";

// The bytes of a file. Throws SceneError as reading a document does.
std::string text_of(const std::filesystem::path& file) {
    std::error_code error;
    const bool is_regular = std::filesystem::is_regular_file(file, error);
    if (is_regular && std::filesystem::file_size(file, error) <= Document::max_bytes) {
        std::ifstream in(file, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(in), {}};
        if (in.is_open() && !in.bad()) return text;
    }
    return Document::from_file(file).text();  // throws, unless the file has appeared meanwhile
}

// Keeps the file's permissions.
void write_text(const std::filesystem::path& file, const std::string& text) {
    std::error_code ignored;
    const std::filesystem::perms permissions = std::filesystem::status(file, ignored).permissions();
    const bool is_there = std::filesystem::exists(file, ignored);
    write_file(text, file);
    if (is_there) std::filesystem::permissions(file, permissions);
}

}  // namespace

EditedDocument::EditedDocument(Options options) : options_(std::move(options)) {
    known_.add(options_.file);
    history_.emplace(text_of(options_.file));
    saved_ = std::make_shared<const std::string>(history_->text());
    auto state = std::make_shared<DocumentState>();
    state->version = state->text_version = 0;
    state_ = std::move(state);
    commit();
}

std::shared_ptr<const DocumentState> EditedDocument::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

std::shared_ptr<const DocumentState> EditedDocument::state_after(std::uint64_t version,
                                                                 std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    published_.wait_for(lock, timeout, [&] { return is_stopped_ || state_->version > version; });
    return state_;
}

void EditedDocument::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    published_.notify_all();
}

void EditedDocument::publish(const std::function<void(DocumentState&)>& change) {
    const std::lock_guard lock(mutex_);
    auto next = std::make_shared<DocumentState>(*state_);
    change(*next);
    ++next->version;
    state_ = std::move(next);
    published_.notify_all();
}

// Publishes the history's text.
void EditedDocument::commit(bool is_known_to_be_valid) {
    auto text = std::make_shared<const std::string>(history_->text());
    std::optional<Document> document;
    std::optional<SceneError> error;
    try {
        document = options_.parse(*text);
    } catch (const SceneError& e) {
        error = e;
    }
    publish([&](DocumentState& state) {
        if (!state.text || *state.text != *text) {
            ++state.text_version;
            state.is_checked = error.has_value() || is_known_to_be_valid;
            if (state.is_checked) state.error = error;
        }
        state.text = text;
        state.document = document;
        state.unreadable.reset();
        state.undo = history_->undo_label();
        state.redo = history_->redo_label();
        state.is_saved = *text == *saved_;
        recent_.push_back({state.version + 1, text});
    });
    std::size_t bytes = 0;
    for (const RecentText& recent : recent_) bytes += recent.text->size();
    while (recent_.size() > 1 && (recent_.size() > max_recent_texts || bytes > max_recent_bytes)) {
        bytes -= recent_.front().text->size();
        recent_.pop_front();
    }
    changed_();
}

// Takes over what another program has saved.
void EditedDocument::adopt_file() {
    const WatchedFiles now = known_.now();
    if (now == known_) return;
    known_ = now;
    seen_.reset();
    std::string text;
    try {
        text = text_of(options_.file);
    } catch (const SceneError& e) {
        publish([&](DocumentState& state) { state.unreadable = e; });
        changed_();
        return;
    }
    saved_ = std::make_shared<const std::string>(text);
    // Repeated attempts to repair an invalid text are one step.
    const bool was_invalid = !state()->document;
    history_->add(std::move(text), label_of_outside,
                  was_invalid ? std::optional<std::string>("outside") : std::nullopt);
    commit();
}

void EditedDocument::poll_file() {
    const std::unique_lock lock(editing_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const WatchedFiles now = known_.now();
    if (now == known_) {
        seen_.reset();
        return;
    }
    // Read a file only after two checks with the same state, because some programs save in several steps.
    if (std::exchange(seen_, now) == now) adopt_file();
}

void EditedDocument::save_text() {
    const auto text = state()->text;
    std::string failure;
    try {
        write_text(options_.file, *text);
    } catch (const std::exception& e) {
        failure = e.what();
    }
    known_ = known_.now();
    if (failure.empty()) saved_ = text;
    const bool becomes_readable = failure.empty() && state()->unreadable;
    publish([&](DocumentState& state) {
        state.is_saved = failure.empty();
        state.save_error = failure;
        if (failure.empty()) state.unreadable.reset();
    });
    if (becomes_readable) changed_();
}

std::uint64_t EditedDocument::finish(bool is_known_to_be_valid) {
    commit(is_known_to_be_valid);
    if (options_.saves && *saved_ != history_->text()) save_text();
    return state()->version;
}

void EditedDocument::check_base(const EditRequest& request) const {
    const std::shared_ptr<const DocumentState> present = state();
    if (request.base > present->version)
        throw ConflictError(fmt::format("there is no version {} yet; read the document again", request.base));
    std::shared_ptr<const std::string> base;
    for (const RecentText& recent : recent_)
        if (recent.from_version <= request.base) base = recent.text;
    if (base && *base == *present->text) return;
    if (!base)
        throw ConflictError(
            fmt::format("the document has changed too often since version {}; read it again", request.base));
    try {
        const Document before = options_.parse(*base);
        if (!present->document) throw ConflictError("the document is no longer valid JSON; read it again");
        check_rebase(before, *present->document, request.operations);
    } catch (const SceneError&) {
        throw ConflictError("the document was not valid JSON, and has changed since; read it again");
    }
}

void EditedDocument::check(const Document& document) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + options_.longest_check;
    const PreparationWatch watch({.cancelled = [&] { return is_stopped_ || Clock::now() > end; }, .progress = {}});
    try {
        options_.check(document);
    } catch (const PreparationCancelled&) {
        throw SceneError(options_.file.string(),
                         fmt::format("checking the scene after this change took more than {} s, so the change was "
                                     "rejected; make it in the text editor, which does not check first",
                                     std::chrono::duration<double>(options_.longest_check).count()));
    }
}

std::string EditedDocument::with_operations(const EditRequest& request) {
    std::string text = history_->text();
    if (request.operations.size() > most_operations)
        throw SceneError(options_.file.string(),
                         fmt::format("a request may have at most {} operations", most_operations));
    std::optional<Document> document = state()->document;
    std::size_t work = 0;
    for (const Operation& operation : request.operations) {
        work += text.size();
        if (work > most_bytes_of_work)
            throw SceneError(options_.file.string(), "the request has too many operations for a text of this size");
        const bool is_whole = std::holds_alternative<ReplaceText>(operation);
        // Throws SceneError if the text is invalid.
        if (!document) document = is_whole ? Document::from_text("{}") : options_.parse(text);
        text = applied(*document, operation, vocabulary_);
        if (text.size() > most_bytes_of_text)
            throw SceneError(options_.file.string(),
                             fmt::format("a text of more than {} MiB cannot be edited here; use a text editor",
                                         most_bytes_of_text >> 20));
        document.reset();
        if (!is_whole) document = options_.parse(text);
    }
    if (request.is_strict) check(document ? *document : options_.parse(text));
    return text;
}

std::uint64_t EditedDocument::edit(const EditRequest& request) {
    const std::lock_guard lock(editing_);
    adopt_file();
    check_base(request);
    std::string text;
    try {
        text = with_operations(request);
    } catch (const SceneError& e) {
        const auto present = state();
        bool is_of_older_text = false;
        for (const RecentText& recent : recent_)
            if (recent.from_version <= request.base) is_of_older_text = *recent.text != *present->text;
        if (!is_of_older_text) throw;
        throw ConflictError(e.what());
    }
    if (text == history_->text()) return state()->version;
    history_->add(std::move(text), request.label, request.merge);
    return finish(request.is_strict);
}

std::uint64_t EditedDocument::edit(const std::string& label,
                                   const std::function<std::string(const Document&)>& change) {
    const std::lock_guard lock(editing_);
    adopt_file();
    const auto present = state();
    if (present->unreadable) throw *present->unreadable;
    std::string text = change(present->document ? *present->document : options_.parse(history_->text()));
    if (text != history_->text()) {
        history_->add(std::move(text), label);
        commit();
    }
    // Save even if options_.saves is false: this function serves buttons that write into the file.
    if (*saved_ != history_->text()) {
        save_text();
        if (const auto after = state(); !after->is_saved) throw OutputError(after->save_error);
    }
    return state()->version;
}

std::uint64_t EditedDocument::step(bool (History::*move)()) {
    const std::lock_guard lock(editing_);
    adopt_file();
    if (!((*history_).*move)()) return state()->version;
    return finish();
}

std::uint64_t EditedDocument::undo() {
    return step(&History::undo);
}

std::uint64_t EditedDocument::redo() {
    return step(&History::redo);
}

std::uint64_t EditedDocument::save() {
    const std::lock_guard lock(editing_);
    adopt_file();
    save_text();
    const auto after = state();
    if (!after->is_saved) throw OutputError(after->save_error);
    return after->version;
}

void EditedDocument::record_check(std::uint64_t text_version, const std::optional<SceneError>& error) {
    const auto present = state();
    if (present->text_version != text_version) return;
    const auto what = [](const std::optional<SceneError>& e) { return e ? std::string(e->what()) : std::string(); };
    if (present->is_checked && what(present->error) == what(error)) return;
    publish([&](DocumentState& state) {
        if (state.text_version != text_version) return;
        state.error = error;
        state.is_checked = true;
    });
}

}  // namespace phasetree::tracer::studio
