#include "vtkPVSVOReasonInformation.h"

#include "vtkClientServerStream.h"
#include "vtkCompositeRepresentation.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataRepresentation.h"
#include "vtkPVView.h"
#include "vtkSVOViewPass.h"

vtkStandardNewMacro(vtkPVSVOReasonInformation);

std::string vtkPVSVOReasonInformation::GetText(
  const std::map<std::string, std::string>& sources) const
{
  std::multimap<std::string, std::string> lines;
  for (const auto& [name, reason] : this->Reasons)
  {
    const auto source = sources.find(name);
    lines.emplace(
      source == sources.end() ? name.substr(0, name.find('(')) : source->second, reason);
  }
  std::string text;
  for (const auto& [name, reason] : lines)
  {
    text += name.empty() ? reason : name + ": " + reason + '\n';
  }
  return text;
}

void vtkPVSVOReasonInformation::CopyFromObject(vtkObject* object)
{
  this->Reasons.clear();
  const auto add = [this](vtkPVDataRepresentation* shown, const std::string& name)
  {
    const std::string reason = vtkSVOViewPass::GetReason(shown);
    if (!reason.empty())
    {
      this->Reasons[name] = reason;
    }
  };
  if (auto* view = vtkPVView::SafeDownCast(object))
  {
    for (int i = 0; i < view->GetNumberOfRepresentations(); ++i)
    {
      // The representations that it chooses between, and selections, are in the view as well.
      if (auto* shown = vtkCompositeRepresentation::SafeDownCast(view->GetRepresentation(i)))
      {
        add(shown, shown->GetLogName());
      }
    }
  }
  else
  {
    add(vtkPVDataRepresentation::SafeDownCast(object), std::string());
  }
}

void vtkPVSVOReasonInformation::AddInformation(vtkPVInformation* other)
{
  if (auto* others = vtkPVSVOReasonInformation::SafeDownCast(other))
  {
    for (const auto& [name, reason] : others->Reasons)
    {
      // Who has no part of the surface has less to say about it.
      std::string& known = this->Reasons[name];
      known = reason.size() > known.size() ? reason : known;
    }
  }
}

void vtkPVSVOReasonInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply;
  for (const auto& [name, reason] : this->Reasons)
  {
    *stream << name << reason;
  }
  *stream << vtkClientServerStream::End;
}

void vtkPVSVOReasonInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Reasons.clear();
  std::string name, reason;
  for (int i = 0; i + 1 < stream->GetNumberOfArguments(0); i += 2)
  {
    if (stream->GetArgument(0, i, &name) && stream->GetArgument(0, i + 1, &reason))
    {
      this->Reasons[name] = reason;
    }
  }
}

void vtkPVSVOReasonInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Text: " << this->GetText() << '\n';
}
