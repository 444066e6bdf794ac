#pragma once

#include <csv.h>

#include <string>
#include <string_view>
#include <vector>

namespace lyrefit {

constexpr char kFieldMarks[] = {'\t', ';', ',', '|'};  // between fields, in the order of trial

// Whether a line that begins with this character is a comment.
constexpr bool BeginsComment(char c) { return c == '#' || c == '%'; }

// Whether a line is blank or a rule drawn between head and rows: "|---|---|", "-----+-----", "====".
bool IsBlankOrRule(std::string_view line);

// Reads the lines of a text, numbered from 1. Line ends are LF, CRLF or, in a text without LF, CR.
class LineReader {
 public:
  // Starts at byte `offset`, after `lines_before` lines.
  explicit LineReader(std::string_view text, std::size_t offset = 0, int lines_before = 0);

  // Reads the next line, without its line end; false at the end of the text.
  bool Next(std::string_view* line);

  // Reads the next line that is neither blank, a rule, nor a comment ('#' or '%').
  bool NextContent(std::string_view* line);

  // Also returns in `offset` where the line begins.
  bool NextContent(std::string_view* line, std::size_t* offset);

  // Returns to the last line read, which began at `offset`, so that it is read again.
  void StepBack(std::size_t offset) {
    at_ = offset;
    --number_;
  }

  int number() const { return number_; }  // of the last line read
  std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
  char end_ = '\n';
};

// Splits lines at a delimiter with libcsv, which handles quotes and blanks around fields. The
// delimiter ' ' stands for any run of blanks and tabs.
class LineSplitter {
 public:
  explicit LineSplitter(char delimiter);
  ~LineSplitter();
  LineSplitter(const LineSplitter&) = delete;
  LineSplitter& operator=(const LineSplitter&) = delete;

  // Splits a line; false if quotes do not close. The fields stay valid until the next call.
  bool Split(std::string_view line);

  std::size_t size() const { return ends_.size(); }
  std::string_view operator[](std::size_t i) const;

 private:
  static void TakeField(void* text, std::size_t length, void* self);

  char delimiter_;
  csv_parser parser_;
  std::string line_;     // with tabs replaced if blanks separate
  std::string content_;  // all fields, concatenated
  std::vector<std::size_t> ends_;
};

// Byte position, from 1, at which field `index` (from 0) of `line` begins.
int FieldColumn(std::string_view line, char delimiter, std::size_t index);

}  // namespace lyrefit
