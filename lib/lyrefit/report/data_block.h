#pragma once

#include <initializer_list>
#include <string>

// The data of pictures: named blocks of rows, and plot commands that leave out what has none.
namespace lyrefit {

// Rows of gnuplot data; those that hold something not finite are left out.
class DataBlock {
 public:
  explicit DataBlock(const std::string& name) : name_(name) {}
  void Add(std::initializer_list<double> row);
  void EndLine() { text_ += "\n"; }  // the next row is not joined to the last
  std::string Text() const;
  bool empty() const { return rows_ == 0; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::string text_;
  int rows_ = 0;
};

// Appends to a plot command how `block` is drawn, "using 1:2 with lines", unless it has no rows.
void JoinPlot(const DataBlock& block, const std::string& how, std::string* command);

// The command as a line; an empty panel if it draws nothing.
std::string PlotLine(std::string command);

}  // namespace lyrefit
