// What a tracer says that has none of it.
#include "svoTracer.h"

#include "svoEyeCode.h"
#include "svoLightCode.h"

namespace svo
{
Tracer::~Tracer() = default;

const EyeCode& Tracer::eyeCode() const
{
  static const EyeCode None;
  return None;
}

const LightCode& Tracer::lightCode() const
{
  static const LightCode None;
  return None;
}

const ReceiverShares& Tracer::receiverShares() const
{
  static const ReceiverShares None;
  return None;
}
}
