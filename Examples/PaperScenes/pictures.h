// Writes pictures of the scenes and the frames of the movie.
#ifndef PaperScenes_pictures_h
#define PaperScenes_pictures_h

#include "scenes.h"

#include <vtkRenderWindow.h>

#include <functional>
#include <string>
#include <vector>

namespace paper
{
/// Draws a frame and writes it as a PNG file. False if that cannot be written.
bool writePicture(vtkRenderWindow* window, const std::string& path);

/// How many of the movie's @a frames a scene gets: the last of the experiments gets twice its
/// share.
int movieShare(const Experiment& experiment, const std::vector<const Experiment*>& all, int frames);

/**
 * Writes @a frames frames of a scene as <folder>/frame-00000.png and so on from number @a first.
 * The viewpoints take turns, each in a slow orbit. False if a file cannot be written.
 */
bool writeMovieFrames(vtkRenderWindow* window, Scene& scene, const std::string& folder, int first,
  int frames, const std::function<void()>& afterFrame);
}

#endif
