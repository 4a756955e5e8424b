// A template: it was not run. It lets Contort test the animation of a skeletal mesh in Unreal Engine 5, over TCP, as a
// commandlet: UnrealEditor-Cmd Project.uproject -run=ContortGuest -mesh=/Game/Mesh -nullrhi -unattended. Declare the
// class in a header of your editor module, and add Sockets, Networking and Json to the modules that it depends on:
//   UCLASS() class UContortGuestCommandlet : public UCommandlet {
//     GENERATED_BODY()
//     virtual int32 Main(const FString& Params) override;
//   };
#include "ContortGuestCommandlet.h"

#include "Animation/AnimSingleNodeInstance.h"
#include "Common/TcpSocketBuilder.h"
#include "Components/SkeletalMeshComponent.h"
#include "Dom/JsonObject.h"
#include "Serialization/JsonReader.h"
#include "Serialization/JsonSerializer.h"
#include "Sockets.h"

namespace {

// JSON without contort and token. Unreal has z up and is left-handed; its unit is 0.01 m. List the joints of your mesh
// in the order of its reference skeleton, and the assets of your sequences as choices.
const FString kManifest = TEXT(
    R"("name":"unreal","convention":{"up":"+z","forward":"+y","unit_m":0.01,"handed":"left"},)"
    R"("characters":[{"name":"hero","joints":[{"name":"root"}]}],)"
    R"("actions":[{"name":"play","effect":"cut","params":{"clip":{"type":"choice","choices":["/Game/Walk.Walk"]}}}])");

void Send(FSocket& Socket, const FString& Line, const TArray<uint8>& Bytes) {
  const FTCHARToUTF8 Head(*(Line + TEXT("\n")));
  TArray<uint8> Reply(reinterpret_cast<const uint8*>(Head.Get()), Head.Length());
  Reply.Append(Bytes);
  for (int32 Sent = 0, Now = 0; Sent < Reply.Num(); Sent += Now)
    if (!Socket.Send(Reply.GetData() + Sent, Reply.Num() - Sent, Now)) return;
}

bool ReadLine(FSocket& Socket, FString& Line) {
  TArray<uint8> Bytes;
  uint8 Byte = 0;
  for (int32 Count = 0; Socket.Recv(&Byte, 1, Count) && Count == 1; Bytes.Add(Byte))
    if (Byte == '\n') {
      Bytes.Add(0);
      Line = UTF8_TO_TCHAR(Bytes.GetData());
      return true;
    }
  return false;
}

void AddRow(const USkeletalMeshComponent& Mesh, TArray<uint8>& Bytes) {
  const auto Add = [&](double Value) { Bytes.Append(reinterpret_cast<const uint8*>(&Value), sizeof Value); };
  const TArray<FTransform> Local = Mesh.GetBoneSpaceTransforms();
  const FVector At = Local[0].GetTranslation();
  for (const double Value : {At.X, At.Y, At.Z}) Add(Value);
  for (const FTransform& Bone : Local) {
    const FQuat Turned = Bone.GetRotation();
    for (const double Value : {Turned.X, Turned.Y, Turned.Z, Turned.W}) Add(Value);
  }
}

// Performs one use of an action. Add your own actions here.
void Begin(USkeletalMeshComponent& Mesh, const FJsonObject& Use) {
  if (Use.GetStringField(TEXT("action")) != TEXT("play")) return;
  const FString Clip = Use.GetObjectField(TEXT("params"))->GetStringField(TEXT("clip"));
  Mesh.PlayAnimation(LoadObject<UAnimationAsset>(nullptr, *Clip), true);
}

TArray<uint8> Generate(USkeletalMeshComponent& Mesh, const FJsonObject& Message) {
  TArray<uint8> Bytes;
  const TArray<TSharedPtr<FJsonValue>>& Timeline = Message.GetArrayField(TEXT("timeline"));
  Mesh.InitAnim(true);  // resets the animation for each request
  int32 Next = 0;
  for (int32 Frame = 0; Frame < Message.GetIntegerField(TEXT("frames")); ++Frame) {
    for (; Next < Timeline.Num() && Timeline[Next]->AsObject()->GetIntegerField(TEXT("start_frame")) <= Frame; ++Next)
      Begin(Mesh, *Timeline[Next]->AsObject());
    Mesh.TickAnimation(Frame == 0 ? 0.f : static_cast<float>(1.0 / Message.GetNumberField(TEXT("rate_hz"))), false);
    Mesh.RefreshBoneTransforms();
    AddRow(Mesh, Bytes);
  }
  return Bytes;
}

}  // namespace

int32 UContortGuestCommandlet::Main(const FString& Params) {
  FString MeshPath;
  FParse::Value(*Params, TEXT("mesh="), MeshPath);
  UWorld* World = UWorld::CreateWorld(EWorldType::Game, false);
  AActor* Actor = World->SpawnActor<AActor>();
  auto* Mesh = NewObject<USkeletalMeshComponent>(Actor);
  Mesh->SetSkeletalMesh(LoadObject<USkeletalMesh>(nullptr, *MeshPath));
  Mesh->RegisterComponentWithWorld(World);

  FSocket* Socket = FTcpSocketBuilder(TEXT("contort")).AsBlocking().Build();
  Socket->SetNoDelay(true);
  const int32 Port = FCString::Atoi(*FPlatformMisc::GetEnvironmentVariable(TEXT("CONTORT_PORT")));
  if (!Socket->Connect(*FIPv4Endpoint(FIPv4Address(127, 0, 0, 1), Port).ToInternetAddr())) return 1;
  for (FString Line; ReadLine(*Socket, Line);) {
    TSharedPtr<FJsonObject> Message;
    FJsonSerializer::Deserialize(TJsonReaderFactory<>::Create(Line), Message);
    if (Message->GetStringField(TEXT("op")) == TEXT("hello")) {
      const FString Token = FPlatformMisc::GetEnvironmentVariable(TEXT("CONTORT_TOKEN"));
      Send(*Socket, TEXT("{\"contort\":1,\"token\":\"") + Token + TEXT("\",") + kManifest + TEXT("}"), {});
      continue;
    }
    const TArray<uint8> Bytes = Generate(*Mesh, *Message);
    const int64 Id = static_cast<int64>(Message->GetNumberField(TEXT("id")));
    Send(*Socket, FString::Printf(TEXT("{\"id\":%lld,\"bytes\":%d}"), Id, Bytes.Num()), Bytes);
  }
  return 0;
}
