// Prints the table and writes the JSON file.
#include "report.h"

#include <vtk_jsoncpp.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

namespace paper
{
namespace
{
constexpr int titleWidth = 44;
constexpr int columnWidth = 10;

using Cell = std::function<std::string(const SceneFigures&)>;

std::string number(double value, int decimals)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

/// 123 456, as the notes write it.
std::string grouped(vtkIdType value)
{
  std::string digits = std::to_string(value);
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
  {
    digits.insert(i, " ");
  }
  return digits;
}

std::string padded(const std::string& text, int width, bool right)
{
  const std::string space(std::max(0, width - static_cast<int>(text.size())), ' ');
  return right ? space + text : text + space;
}

void addRow(std::ostream& out, const Figures& figures, const std::string& title, const Cell& cell)
{
  out << padded(title, titleWidth, false);
  for (const SceneFigures& scene : figures.scenes)
  {
    out << padded(cell(scene), columnWidth, true);
  }
  out << "\n";
}

Cell framesPerSecond(const std::string& method)
{
  return [method](const SceneFigures& scene)
  {
    const auto found = scene.timings.find(method);
    if (found == scene.timings.end())
    {
      return std::string("-");
    }
    const double fps = found->second.framesPerSecond();
    return number(fps, fps < 100 ? 1 : 0);
  };
}

std::string heading(const Method& method)
{
  switch (method.technique)
  {
    case Technique::Octrees:
      return method.light == LightKind::Point ? "vtkSVORenderPass, point light as in the paper"
                                              : "vtkSVORenderPass, spot light at the same place";
    case Technique::ShadowMaps:
    case Technique::Rasterizer:
    case Technique::Empty:
      return "VTK's own rasteriser (vtkShadowMapPass: same spot light)";
  }
  return {};
}
}

std::string table(const Figures& figures)
{
  std::ostringstream out;
  out << "Object A: " << grouped(figures.trianglesOfA) << " triangles, " << figures.sourceOfA
      << "\nObject B: " << posesOfB << " poses of " << grouped(figures.trianglesOfB)
      << " triangles, " << figures.sourceOfB << "\n"
      << figures.size[0] << " x " << figures.size[1] << ", octree level " << figures.level
      << ", shadow buffers and maps of " << figures.shadowMapResolution << " x "
      << figures.shadowMapResolution << ", no multisampling\n"
      << figures.processors << " processors: " << figures.processor << ", octrees with "
      << figures.instructionSet << "\nVTK " << figures.vtkVersion
      << " on OpenGL: " << figures.openGL << "\n\n";

  addRow(out, figures, "scene", [](const SceneFigures& s) { return s.name; });
  addRow(
    out, figures, "objects, on a ground plane", [](const SceneFigures& s) { return s.objects; });
  addRow(out, figures, "triangles shown",
    [](const SceneFigures& s) { return grouped(s.trianglesShown); });
  addRow(out, figures, "triangles in memory",
    [](const SceneFigures& s) { return grouped(s.trianglesInMemory); });
  addRow(out, figures, "pixels on objects, least view, %",
    [](const SceneFigures& s)
    { return number(100 * *std::min_element(s.coverage.begin(), s.coverage.end()), 0); });
  addRow(out, figures, "octrees (A, poses of B, ground): voxels, 10^6",
    [](const SceneFigures& s) { return number(1e-6 * s.voxels, 2); });
  addRow(out, figures, "  memory, MiB",
    [](const SceneFigures& s) { return number(s.octreeMebibytes, 1); });
  addRow(out, figures, "  build time, s",
    [](const SceneFigures& s) { return number(s.buildSeconds, 2); });

  out << "\nFrames per second (medians of " << figures.framesPerMedian << " frames from "
      << (figures.scenes.empty() ? 0 : figures.scenes.front().coverage.size()) << " viewpoints)\n";
  std::string last;
  for (const Method& method : methods())
  {
    if (heading(method) != last)
    {
      last = heading(method);
      out << last << "\n";
    }
    addRow(out, figures, "  " + method.title, framesPerSecond(method.name));
  }
  out << "Huang & Cheng 2017, 1920 x 1080, Core 2 Quad Q6600 with a GeForce GTX 750 Ti\n";
  addRow(out, figures, "  table 2 of the paper",
    [](const SceneFigures& s) { return s.paperFramesPerSecond; });
  return out.str();
}

bool writeJson(const Figures& figures, const std::string& path)
{
  Json::Value root;
  root["width"] = figures.size[0];
  root["height"] = figures.size[1];
  root["octree_level"] = figures.level;
  root["shadow_map_resolution"] = figures.shadowMapResolution;
  root["processors"] = figures.processors;
  root["processor"] = figures.processor;
  root["instruction_set"] = figures.instructionSet;
  root["opengl"] = figures.openGL;
  root["vtk"] = figures.vtkVersion;
  root["object_a"]["source"] = figures.sourceOfA;
  root["object_a"]["triangles"] = Json::Int64(figures.trianglesOfA);
  root["object_b"]["source"] = figures.sourceOfB;
  root["object_b"]["triangles_per_pose"] = Json::Int64(figures.trianglesOfB);
  root["object_b"]["poses"] = posesOfB;
  for (const SceneFigures& scene : figures.scenes)
  {
    Json::Value& entry = root["scenes"][scene.name];
    entry["objects"] = scene.objects;
    entry["triangles_shown"] = Json::Int64(scene.trianglesShown);
    entry["triangles_in_memory"] = Json::Int64(scene.trianglesInMemory);
    entry["octree_voxels"] = Json::Int64(scene.voxels);
    entry["octree_mebibytes"] = scene.octreeMebibytes;
    entry["octree_build_seconds"] = scene.buildSeconds;
    for (std::size_t i = 0; i < scene.coverage.size(); ++i)
    {
      entry["object_coverage"][scene.viewpoints[i]] = scene.coverage[i];
    }
    entry["paper_frames_per_second"] = scene.paperFramesPerSecond;
    for (const auto& [name, timing] : scene.timings)
    {
      Json::Value& times = entry["methods"][name];
      times["median_ms"] = timing.medianMilliseconds;
      times["slowest_ms"] = timing.slowestMilliseconds;
      times["median_processor_ms"] = timing.processorMilliseconds;
      for (const auto& [key, value] : timing.statistics)
      {
        times["last_frame"][key] = value;
      }
      times["frames"] = timing.frames;
      times["frames_per_second"] = timing.framesPerSecond();
    }
  }
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["precision"] = 6;
  std::ofstream file(path);
  const std::unique_ptr<Json::StreamWriter> writer(builder.newStreamWriter());
  writer->write(root, &file);
  file << "\n";
  return static_cast<bool>(file.flush());
}
}
