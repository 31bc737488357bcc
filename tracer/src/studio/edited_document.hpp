// A scene file that is being edited: its text, its history and its file.
//
// Every change to the text goes through this class, whether it comes from a page, from a button that writes into the
// file, or from another program that has saved the file. A page is a browser tab that shows the studio, the editor of
// scenes. All functions may be called by any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "phasetree/io/document.hpp"
#include "studio/history.hpp"
#include "studio/operation.hpp"
#include "studio/vocabulary.hpp"
#include "studio/watched_files.hpp"

namespace phasetree::tracer::studio {

/// A request was made for an older version of the text, and its operations may mean something else by now.
class ConflictError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The state of an edited document at one moment. Immutable once published.
struct DocumentState {
    std::uint64_t version = 1;       ///< increases whenever anything here changes
    std::uint64_t text_version = 1;  ///< increases whenever the text changes
    std::shared_ptr<const std::string> text;
    std::optional<Document> document;       ///< the text, if it is valid JSON
    std::optional<SceneError> error;        ///< what is wrong with the text, or with the scene that it describes
    bool is_checked = false;                ///< whether `error` is about this text, and not about the one before
    std::optional<SceneError> unreadable;   ///< why the file cannot be read, if it cannot
    std::optional<std::string> undo, redo;  ///< labels
    bool is_saved = true;
    std::string save_error;  ///< why the last attempt to save failed; empty if it did not
};

/// A request to change the text.
struct EditRequest {
    std::uint64_t base = 0;  ///< DocumentState::version when the request was made
    std::string label;
    std::optional<std::string> merge;  ///< requests with the same key, such as those of one drag, form one undo step
    bool is_strict = false;            ///< whether to reject an invalid scene
    std::vector<Operation> operations;
};

class EditedDocument {
  public:
    static constexpr std::size_t most_bytes_of_text = std::size_t{4} << 20;    ///< of texts that can be edited
    static constexpr std::size_t most_operations = 1000;                       ///< of a request
    static constexpr std::size_t most_bytes_of_work = std::size_t{256} << 20;  ///< operations times bytes

    struct Options {
        std::filesystem::path file;
        bool saves = true;  ///< whether each step is saved at once (that of edit(label, change) always is)
        /// Parses a text with the program's options for reading scenes. Throws SceneError.
        std::function<Document(std::string)> parse;
        /// Throws SceneError if the scene is invalid, and PreparationCancelled if the current PreparationWatch cancels
        /// it. Called only for strict requests.
        std::function<void(const Document&)> check = [](const Document&) {};
        /// A strict request is rejected if its check takes longer. Other requests wait meanwhile.
        std::chrono::milliseconds longest_check{10000};
    };

    /// Reads the file. Throws SceneError if that is impossible; an invalid text is no error here.
    explicit EditedDocument(Options options);

    /// Called after each change of the text, and when the file becomes unreadable or readable. Set it before the
    /// document is shared between threads.
    void on_change(std::function<void()> changed) { changed_ = std::move(changed); }

    std::shared_ptr<const DocumentState> state() const;
    /// Waits until the version exceeds `version`, until the timeout, or until stop().
    std::shared_ptr<const DocumentState> state_after(std::uint64_t version, std::chrono::milliseconds timeout) const;
    void stop();

    /// All return the new version. Throw SceneError if an operation is impossible, and ConflictError if the text has
    /// changed since EditRequest::base in a way that affects the operations (rebase.hpp).
    std::uint64_t edit(const EditRequest& request);
    /// Changes the text by a function of the document, and saves it even if Options::saves is false. Throws SceneError
    /// if the file cannot be read, and OutputError if it cannot be saved.
    std::uint64_t edit(const std::string& label, const std::function<std::string(const Document&)>& change);
    std::uint64_t undo();
    std::uint64_t redo();
    /// Writes the text into the file. Throws OutputError.
    std::uint64_t save();

    /// Adopts the text when another program has saved the file. Call this periodically.
    void poll_file();

    /// Records what reading the scene found: an error, or none.
    void record_check(std::uint64_t text_version, const std::optional<SceneError>& error);

    /// Parses a text with Options::parse. Throws SceneError.
    Document parsed(std::string text) const { return options_.parse(std::move(text)); }
    const Vocabulary& vocabulary() const { return vocabulary_; }
    const std::filesystem::path& file() const { return options_.file; }

  private:
    // A text that pages may still refer to.
    struct RecentText {
        std::uint64_t from_version;
        std::shared_ptr<const std::string> text;
    };

    // All require `editing_`.
    void adopt_file();
    void commit(bool is_known_to_be_valid = false);
    void check(const Document&) const;
    void save_text();
    std::string with_operations(const EditRequest& request);
    void check_base(const EditRequest& request) const;
    std::uint64_t step(bool (History::*move)());
    std::uint64_t finish(bool is_known_to_be_valid = false);

    void publish(const std::function<void(DocumentState&)>& change);

    const Options options_;
    const Vocabulary vocabulary_;
    std::function<void()> changed_ = [] {};

    mutable std::mutex editing_;  // held while the text changes and is saved
    std::optional<History> history_;
    std::shared_ptr<const std::string> saved_;
    std::deque<RecentText> recent_;
    WatchedFiles known_;                // the file as it was last read or written
    std::optional<WatchedFiles> seen_;  // the file when a change was last seen

    mutable std::mutex mutex_;  // protects what follows; locked after `editing_`
    mutable std::condition_variable published_;
    std::shared_ptr<const DocumentState> state_;
    std::atomic<bool> is_stopped_{false};
};

}  // namespace phasetree::tracer::studio
