#pragma once

#include <filesystem>

namespace strut::io {

// Forces everything written to the file so far to the disk, so that a power failure does not lose it. Throws
// Error.
void force_to_disk(const std::filesystem::path& path);

}  // namespace strut::io
