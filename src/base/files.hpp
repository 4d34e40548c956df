// The rule by which all programs of strut write files. An existing file is replaced only by one of its own kind, so
// that a wrong name costs no mesh, deck or recipe. Two names denote one file if they lead to the same file, however
// they are spelled.
#pragma once

#include <filesystem>
#include <string>

namespace strut {

// True if both names lead to one file, through links, folders and hard links. Files that do not exist yet are the same
// if they are in one folder and their names differ at most in case, which some file systems ignore.
bool same_file(const std::filesystem::path& one, const std::filesystem::path& other);

// Where a link leads, also to a file that does not exist; a name that is no link itself.
std::filesystem::path destination(std::filesystem::path name);

// The reason why a text cannot be read: a sentence that begins with the name of its file; nothing if it can. A pipe
// without a writer would block for ever.
std::string unreadable(const std::filesystem::path& file);

// The kinds of files that our programs write. A lock is an empty file; the others are recognized by their beginning.
// Code that replaces an `unchecked` file checks it first.
enum class FileKind { result, history, checkpoint, lock, log, mesh, unchecked };
bool is_of_kind(const std::filesystem::path& file, FileKind kind);  // also true for an empty file

// The beginning of each log, and of each history.
inline constexpr const char* log_mark = "# log of strut ";
inline constexpr const char* history_mark = "# strut ";
// The titles of a result and of a mesh, and the attribute of a checkpoint.
inline constexpr const char* result_title = "strut";
inline constexpr const char* mesh_title = "strut mesh";
inline constexpr const char* checkpoint_mark = "strut_restart";

// The reason why a file of this kind must not or cannot be written under the name: a sentence that begins with the
// name, in quotes. Nothing if it may.
std::string obstacle(const std::filesystem::path& file, FileKind kind);

// Files beside a checkpoint: the previous one, the one being written, and the lock of the run.
std::filesystem::path before_of(const std::filesystem::path& checkpoint);
std::filesystem::path part_of(const std::filesystem::path& checkpoint);
std::filesystem::path lock_of(const std::filesystem::path& checkpoint);

// Forces everything written to the file so far to the disk, so that a power failure does not lose it. Throws
// Error.
void force_to_disk(const std::filesystem::path& path);

}  // namespace strut
