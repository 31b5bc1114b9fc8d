#include "io/number_table.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <span>

#include "io/line_reader.h"

namespace skinforge {
namespace {

constexpr std::size_t kMaxSide = std::size_t{1} << 31;  // ours: keeps rows * columns in range

class DmatParser {
 public:
  explicit DmatParser(std::string_view text) : lines_(text), size_(text.size()) {}

  Eigen::MatrixXd parse() {
    read_size();
    if (columns_ == 0 && rows_ == 0 && lines_.find_line()) return read_binary();
    if (columns_ * rows_ > size_ / 2)
      lines_.fail(fmt::format("{} columns of {} rows are more than the file holds", columns_, rows_));
    Eigen::MatrixXd table(rows_, columns_);
    for (double& value : values(table)) value = checked(lines_.number<double>(word(), "a value"));
    if (lines_.has_more() || lines_.find_line())
      lines_.fail(fmt::format("more values than {} columns of {} rows", columns_, rows_));
    return table;
  }

 private:
  void read_size() {
    columns_ = lines_.number<std::size_t>(word(), "the number of columns");
    rows_ = lines_.number<std::size_t>(word(), "the number of rows");
    if (columns_ > kMaxSide || rows_ > kMaxSide)
      lines_.fail(fmt::format("{} columns of {} rows", columns_, rows_));
  }

  std::string_view word() {
    if (!lines_.has_more()) lines_.next_line();
    return lines_.next_word();
  }

  // Column after column. Two thousand million columns of no rows are none.
  static std::span<double> values(Eigen::MatrixXd& table) {
    return {table.data(), static_cast<std::size_t>(table.size())};
  }

  double checked(double value) const {
    if (!std::isfinite(value)) lines_.fail("a value is not finite");
    return value;
  }

  Eigen::MatrixXd read_binary() {
    read_size();
    const std::string_view bytes = lines_.rest();
    if (columns_ * rows_ != bytes.size() / sizeof(double) || bytes.size() % sizeof(double) != 0)
      lines_.fail(fmt::format("{} columns of {} rows take {} bytes, the file has {}", columns_, rows_,
                              columns_ * rows_ * sizeof(double), bytes.size()));
    Eigen::MatrixXd table(rows_, columns_);
    if (!bytes.empty()) std::memcpy(table.data(), bytes.data(), bytes.size());
    const std::span<double> all = values(table);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!std::isfinite(all[i]))
        lines_.fail(
            fmt::format("the value in row {} of column {} is not finite", i % rows_ + 1, i / rows_ + 1));
    return table;
  }

  LineReader lines_;
  std::size_t size_, columns_ = 0, rows_ = 0;
};

}  // namespace

Eigen::MatrixXd read_dmat(const InputFile& file) {
  return with_context(printable(file.path), [&] {
    return DmatParser({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()}).parse();
  });
}

std::string write_dmat(const Eigen::MatrixXd& table) {
  std::string text = fmt::format("{} {}\n", table.cols(), table.rows());
  for (const double value : table.reshaped()) fmt::format_to(std::back_inserter(text), "{}\n", value);
  return text;
}

}  // namespace skinforge
