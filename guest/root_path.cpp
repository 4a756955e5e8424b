#include "guest/root_path.h"

#include <cmath>
#include <string>

#include "guest/basis.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

// Logs round quaternions to two or three digits. With greater errors the columns are no quaternion but, for example,
// Euler angles.
constexpr double kGreatestLengthError = 0.02;

std::string quoted_column(const JointTable& table, std::size_t column) {
  return json_fields::quoted(table.columns[column].name);
}

Issue duplicate_root(const JointTable& table, std::size_t one, std::size_t other) {
  return {"table.duplicate_root", "",
          "the columns " + quoted_column(table, one) + " and " + quoted_column(table, other) +
              " both say where the root is; give the one that does not another name"};
}

// Positions without rotations are refused, because they do not give the figure's orientation.
Issue incomplete_root(const JointTable& table, const std::array<std::optional<std::size_t>, kRootNumbers>& found) {
  std::string names, missing;
  for (std::size_t n = 0; n < kRootNumbers; ++n) {
    std::string& list = found[n] ? names : missing;
    list += (list.empty() ? "" : ", ") + (found[n] ? quoted_column(table, *found[n]) : std::string(kRootNames[n]));
  }
  return {"table.incomplete_root", "",
          "some columns say where the root is: " + names + "; missing are " + missing +
              ", or the like. The position and the quaternion belong together. Other columns need another name"};
}

Result<double> metres_per_unit(const TableColumn& column) {
  for (const auto& [unit, metres] : {std::pair("", 1.0), std::pair("m", 1.0), std::pair("cm", 0.01), std::pair("mm", 0.001)})
    if (column.unit == unit) return metres;
  return Issue{"table.wrong_unit", "",
               "column " + json_fields::quoted(column.name) + ": found the unit " + json_fields::quoted(column.unit) +
                   ", allowed are m, cm and mm for the root's position"};
}

Issue bad_quaternion(const JointTable& table, std::size_t row, double length) {
  return {"table.bad_quaternion", "row " + std::to_string(row + 1),
          "the root's quaternion has the length " + number_text(length) + " at " + number_text(table.times_s[row]) +
              " s, expected 1"};
}

}  // namespace

Result<std::optional<RootColumns>> find_root_columns(const JointTable& table, std::span<const std::size_t> free) {
  std::array<std::optional<std::size_t>, kRootNumbers> found{};
  std::size_t count = 0;
  for (const std::size_t column : free) {
    const std::optional<RootNumber> number = root_number_of(table.columns[column].name);
    if (!number) continue;
    std::optional<std::size_t>& place = found[static_cast<std::size_t>(*number)];
    if (place) return duplicate_root(table, *place, column);
    place = column, ++count;
  }
  if (count == 0) return std::optional<RootColumns>();
  if (count < kRootNumbers) return incomplete_root(table, found);
  RootColumns out;
  for (std::size_t n = 0; n < kRootNumbers; ++n) {
    const TableColumn& column = table.columns[*found[n]];
    if (column.fault) return *column.fault;
    const bool is_position = n < 3;
    const Result<double> factor = is_position ? metres_per_unit(column) : Result<double>(1.0);
    if (!factor) return factor.issue();
    out.columns[n] = *found[n], out.factors[n] = *factor;
  }
  return std::optional(out);
}

Result<std::vector<Rigid>> read_root_path(const JointTable& table, const RootColumns& root, bool is_y_up,
                                          const Quat& world_from_root) {
  const Basis basis(is_y_up ? GuestConvention{} : GuestConvention{.up = Axis::plus_z, .forward = Axis::plus_x});
  std::vector<Rigid> path;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const auto number = [&](RootNumber n) {
      const auto index = static_cast<std::size_t>(n);
      return root.factors[index] * table.value(row, root.columns[index]);
    };
    const Quat said(number(RootNumber::qw), number(RootNumber::qx), number(RootNumber::qy), number(RootNumber::qz));
    const double length = std::sqrt(glm::dot(said, said));
    if (!(std::fabs(length - 1.0) <= kGreatestLengthError)) return bad_quaternion(table, row, length);
    const Quat q = normalize(normalize(said) * conjugate(world_from_root));
    const Vec3 p(number(RootNumber::x), number(RootNumber::y), number(RootNumber::z));
    path.push_back({normalize(basis.rotation(q.x, q.y, q.z, q.w)), basis.point_m(p)});
  }
  return path;
}

}  // namespace contort
