#include "base/fields.hpp"

namespace strut {

void FieldSet::resize(std::size_t points) {
  for (const auto& field : fields_) {
    if (field->in_use && field->at == At::point) field->resize(points);
  }
}

double FieldSet::bytes() const {
  double sum = 0;
  for (const auto& field : fields_) sum += field->bytes();
  return sum;
}

void FieldSet::serialize(Archive& archive, const FieldIndices& indices) {
  for (const auto& field : fields_) {
    if (!field->in_use) continue;
    const int count = field->at == At::integration_point ? indices.count : 1;
    int first = 0;
    for (const FieldPart& part : field->parts) {
      const auto index = [&](std::size_t k, int c) { return count > 1 ? indices.index(k, c / part.width) : k; };
      const auto number = [&](int c) { return first + c % part.width; };
      if (part.persistent) {
        archive.numbers(
            part.name, count * part.width, [&](std::size_t k, int c) { return field->number(index(k, c), number(c)); },
            [&](std::size_t k, int c, double value) { field->set_number(index(k, c), number(c), value); });
      }
      first += part.width;
    }
  }
}

template class FieldOf<std::vector<double>>;
template class FieldOf<std::vector<std::uint8_t>>;

}  // namespace strut
