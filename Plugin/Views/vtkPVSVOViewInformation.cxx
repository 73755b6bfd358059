#include "vtkPVSVOViewInformation.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkClientServerStream.h"
#include "vtkMultiProcessStream.h"
#include "vtkObjectFactory.h"
#include "vtkSVORenderPass.h"
#include "vtkSVOViewPass.h"

vtkStandardNewMacro(vtkPVSVOViewInformation);

void vtkPVSVOViewInformation::CopyFromObject(vtkObject* view)
{
  this->Value = 0.0;
  if (vtkSVORenderPass* pass = vtkSVOViewPass::Of(view))
  {
    vtkClientServerStream stream;
    stream << vtkClientServerStream::Invoke << pass << this->Command.c_str()
           << vtkClientServerStream::End;
    auto* interpreter = vtkClientServerInterpreterInitializer::GetGlobalInterpreter();
    interpreter->ProcessStream(stream);
    interpreter->GetLastResult().GetArgument(0, 0, &this->Value);
  }
}

void vtkPVSVOViewInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << this->Value << vtkClientServerStream::End;
}

void vtkPVSVOViewInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  stream->GetArgument(0, 0, &this->Value);
}

void vtkPVSVOViewInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  stream << this->Command;
}

void vtkPVSVOViewInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  stream >> this->Command;
}

void vtkPVSVOViewInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Command: " << this->Command << '\n'
     << indent << "Value: " << this->Value << '\n';
}
