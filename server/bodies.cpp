// Schemas of the bodies of calls.
#include "server/bodies_fields.h"
#include "server/routes.h"

namespace contort::server::schemas {

namespace {

template <class Body>
std::string schema() {
  return json_fields::Codec<Body>::schema({}).dump();
}

}  // namespace

std::string session() { return schema<SessionBody>(); }
std::string enqueue() { return schema<EnqueueBody>(); }
std::string interrupt() { return schema<InterruptBody>(); }
std::string aim() { return schema<AimBody>(); }
std::string push() { return schema<PushBody>(); }
std::string clock() { return schema<ClockBody>(); }
std::string change() { return schema<ChangeBody>(); }
std::string keep_case() { return schema<CaseBody>(); }
std::string acknowledge() { return schema<AcknowledgeBody>(); }
std::string quarantine() { return schema<QuarantineBody>(); }
std::string note() { return schema<NoteBody>(); }
std::string evaluate() { return schema<EvaluateBody>(); }
std::string nothing() { return schema<NoBody>(); }

// Files have different formats, each of which has its own schema.
std::string library() {
  return R"({"type":"object","required":["files"],"additionalProperties":false,"properties":{"files":{"type":"object",)"
         R"("minProperties":1,"maxProperties":256,"additionalProperties":{"type":"object"},)"
         R"("description":"File name to a contort.part/1, .object/1, .character/1 or .action/1."}}})";
}

}  // namespace contort::server::schemas
