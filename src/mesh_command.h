// SPDX-License-Identifier: GPL-3.0-or-later
//
// What commands have in common that make a mesh of a mesh within a tolerance: they read, verify
// independently, and write. Nothing appears on disk before everything has succeeded.
#ifndef SURETY_TOOL_MESH_COMMAND_H
#define SURETY_TOOL_MESH_COMMAND_H

#include "attributes.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"
#include "soup_reading.h"

#include <surety/distance.h>
#include <surety/statistics.h>

#include <optional>
#include <string>
#include <vector>

namespace surety::tool {

class Mesh_command
{
public:
  std::string input, output, tolerance, report;
  Reading reading;
  bool is_quiet = false, skips_verification = false;

protected:
  Mesh_command() = default;
  ~Mesh_command() = default;

  enum class Report_kind { json, json_or_html };
  /// Refuses outputs that cannot be written, or would replace an input, before anything is read.
  void announce_outputs(const std::vector<std::string>& inputs, Report_kind kind);
  /// Reads the input, and the tolerance in its units. To be called first.
  void read();
  /// A length of the command line; 0 if it is not there.
  double in_units(const std::string& text, const char* option) const;
  /// Takes over what the points of the input carry, where the output can hold it.
  void carry();
  /// To be called when the output is there.
  void finish_output();
  void require_no_new_intersections() const;
  /// The independent check.
  void verify(double bound);
  /// Writes the output, and the report if one is wanted.
  /// \param largest the deviation that colours end at
  void write(double largest);
  /// What the report says.
  virtual Json describe() const = 0;
  void describe_input(Json& json) const;

  std::optional<Output_files> files_;
  Stopwatch watch_;
  Mesh input_mesh_, output_mesh_;
  Repairs repairs_;
  Attributes attributes_, carried_;
  Mesh_statistics before_, after_;
  double length_ = 0; ///< the tolerance
  std::optional<Distance_certificate> distance_;
};

} // namespace surety::tool

#endif // SURETY_TOOL_MESH_COMMAND_H
