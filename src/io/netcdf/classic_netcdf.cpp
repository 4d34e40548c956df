// Parses the header of a classic netCDF file (CDF-1, 2 and 5), all numbers big-endian:
//   magic numrecs dims global-attributes variables;  dims: tag count (name length)…
//   attributes: tag count (name type count values)…; variables: tag count (name rank dim-ids attributes type size
//   begin)…
#include "io/netcdf/classic_netcdf.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <vector>

#include "base/errors.hpp"

namespace strut::io {

namespace {

constexpr std::int64_t streaming = 0xffffffff;  // number of records if the writer could not seek

struct Variable {
  bool record = false;  // it has an entry per record
  std::int64_t size = 0;
  std::int64_t begin = 0;
};

class Header {
 public:
  Header(std::ifstream& file, std::int64_t file_size) : file_(file), file_size_(file_size) {}

  // The file size that the header implies, with at most `most_records` records.
  std::int64_t promised_size(std::int64_t most_records) {
    const char version = magic();
    count_bytes_ = version == 5 ? 8 : 4;
    offset_bytes_ = version == 1 ? 4 : 8;
    records_ = count();
    if (records_ != streaming) records_ = std::min(records_, most_records);
    read_dimensions();
    skip_attributes();
    return size_of(read_variables());
  }

 private:
  std::int64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = file_.get();
      if (byte == EOF) throw Error("its header is truncated");
      value = value << 8 | static_cast<std::uint64_t>(byte);
    }
    return static_cast<std::int64_t>(value);
  }

  std::int64_t count() {
    const std::int64_t value = number(count_bytes_);
    if (value < 0) throw Error("its header is malformed");
    return value;
  }

  // Lists give their length; none can exceed the file.
  std::int64_t list_length() {
    number(4);  // the tag of the list
    return plausible(count());
  }

  std::int64_t plausible(std::int64_t length) const {
    if (length < 0 || length > file_size_) throw Error("its header is malformed or truncated");
    return length;
  }

  void skip(std::int64_t bytes) { file_.seekg((plausible(bytes) + 3) / 4 * 4, std::ios::cur); }

  char magic() {
    char text[4] = {};
    file_.read(text, 4);
    return text[3];
  }

  void read_dimensions() {
    for (std::int64_t n = list_length(); n > 0; --n) {
      skip(count());
      dimensions_.push_back(count());
    }
  }

  static int type_size(std::int64_t type) {
    constexpr int sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type < 1 || type > 11) throw Error("its header is malformed");
    return sizes[type];
  }

  void skip_attributes() {
    for (std::int64_t n = list_length(); n > 0; --n) {
      skip(count());
      const int size = type_size(number(4));
      skip(plausible(count()) * size);
    }
  }

  std::vector<Variable> read_variables() {
    std::vector<Variable> variables;
    for (std::int64_t n = list_length(); n > 0; --n) variables.push_back(read_variable());
    return variables;
  }

  Variable read_variable() {
    Variable variable;
    skip(count());
    double entries = 1;  // of one record; a double cannot overflow
    const std::int64_t rank = plausible(count());
    for (std::int64_t axis = 0; axis < rank; ++axis) {
      const std::int64_t dimension = count();
      if (dimension >= static_cast<std::int64_t>(dimensions_.size())) throw Error("its header is malformed");
      const std::int64_t length = dimensions_[dimension];
      if (length == 0) variable.record = true;
      if (length != 0) entries *= static_cast<double>(length);
    }
    skip_attributes();
    const double size = entries * type_size(number(4));
    if (size > 1e15) throw Error("its header is malformed");
    variable.size = static_cast<std::int64_t>(size);
    number(count_bytes_);  // the stored size, which wraps around for large variables
    variable.begin = number(offset_bytes_);
    return variable;
  }

  // Padding at the end of a file may be unwritten without loss, so the size of its last part is not rounded up.
  std::int64_t size_of(const std::vector<Variable>& variables) const {
    const auto padded = [](std::int64_t size) { return (size + 3) / 4 * 4; };
    std::int64_t record_size = 0;
    for (const Variable& v : variables) record_size += v.record ? padded(v.size) : 0;
    std::int64_t end = 0;
    for (const Variable& v : variables) {
      if (v.record && (records_ == 0 || records_ == streaming)) continue;
      const double last = v.record ? static_cast<double>(records_ - 1) * static_cast<double>(record_size) : 0;
      if (v.begin < 0 || static_cast<double>(v.begin) > 1e15 || last > 1e15) throw Error("its header is malformed");
      end = std::max(end, v.begin + static_cast<std::int64_t>(last) + v.size);
    }
    return end;
  }

  std::ifstream& file_;
  std::int64_t file_size_;
  int count_bytes_ = 4;
  int offset_bytes_ = 4;
  std::int64_t records_ = 0;
  std::vector<std::int64_t> dimensions_;
};

}  // namespace

std::string classic_netcdf_problem(const std::filesystem::path& path, std::int64_t records) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "it cannot be read (permissions?)";
  std::string magic(4, '\0');
  file.read(magic.data(), 4);
  if (magic == "\x89HDF") return "";
  if (magic.substr(0, 3) != "CDF" || (magic[3] != 1 && magic[3] != 2 && magic[3] != 5)) {
    return "not an Exodus (netCDF) file";
  }
  file.seekg(0);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  try {
    const std::int64_t promised = Header(file, size).promised_size(records);
    if (size >= promised) return "";
    return "the file is truncated: " + std::to_string(size) + " of " + std::to_string(promised) + " bytes are there";
  } catch (const Error& error) {
    return error.what();
  }
}

bool is_hdf5(const std::filesystem::path& file) {
  std::string magic(4, '\0');  // the rest may be damaged
  if (std::filesystem::is_regular_file(file)) std::ifstream(file, std::ios::binary).read(magic.data(), 4);
  return magic == "\x89HDF";
}

// The number of records follows the magic number, in four bytes (eight in CDF-5), big-endian.
void keep_records(const std::filesystem::path& path, int count) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  char magic[4] = {};
  file.read(magic, 4);
  if (std::string(magic, 3) != "CDF") throw Error(path.string() + ": cannot cut it: it is no classic netCDF file");
  file.seekp(4);  // the standard requires a seek between reading and writing
  for (int byte = (magic[3] == 5 ? 8 : 4) - 1; byte >= 0; --byte) {
    file.put(static_cast<char>(byte < 4 ? static_cast<unsigned>(count) >> 8 * byte & 0xff : 0));
  }
  if (!file.flush()) throw Error(path.string() + ": cannot cut it");
}

}  // namespace strut::io
