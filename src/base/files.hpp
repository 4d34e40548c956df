// What a program of strut may write: the one rule for all of them. A file that is there is replaced only by one of its
// own kind, so that a slip in a name costs no mesh, deck or recipe; and two names are of one file where they lead to
// one, not where they read alike.
#pragma once

#include <filesystem>
#include <string>

namespace strut {

// Whether both names lead to one file, through links, folders and hard links. Of what is not there yet: in one folder,
// names that differ in capital letters at the most, which some file systems take for one.
bool same_file(const std::filesystem::path& one, const std::filesystem::path& other);

// Why a file cannot be read: a sentence that begins with its name; nothing where it can. A pipe without a writer would
// be waited for without an end.
std::string unreadable(const std::filesystem::path& file);

// What our programs write. A lock is an empty file; the others are known by how they begin. Of what is unchecked, who
// replaces it looks at it first.
enum class FileKind { result, history, checkpoint, lock, log, mesh, unchecked };
bool is_of_kind(const std::filesystem::path& file, FileKind kind);  // also one that holds nothing

// Each log begins so, each history with the second.
inline constexpr const char* log_mark = "# log of strut ";
inline constexpr const char* history_mark = "# strut ";
// The title of a result and of a mesh, the attribute of a checkpoint.
inline constexpr const char* result_title = "strut";
inline constexpr const char* mesh_title = "strut mesh";
inline constexpr const char* checkpoint_mark = "strut_restart";

// Why a file of this kind must not or cannot be written under the name: a sentence that begins with the name, in
// quotes. Nothing where it may.
std::string obstacle(const std::filesystem::path& file, FileKind kind);

// Beside a checkpoint: the one before, what is being written, and the lock of the run.
std::filesystem::path before_of(const std::filesystem::path& checkpoint);
std::filesystem::path part_of(const std::filesystem::path& checkpoint);
std::filesystem::path lock_of(const std::filesystem::path& checkpoint);

}  // namespace strut
