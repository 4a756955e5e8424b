// A template: it was not run. It lets Contort test the animation of a Unity scene, over TCP. Put the script on the root
// bone of a character, list the joints and actions in the manifest, and override Begin. Build a player with
// `-batchmode -nographics` and give its command line to `contort fuzz --generator`.
using System;
using System.Collections.Generic;
using System.IO;
using System.Net.Sockets;
using System.Text;
using UnityEngine;

public class ContortGuest : MonoBehaviour
{
    [Serializable] public class Message { public string op; public long id; public string character;
        public double rate_hz; public int frames; public List<Use> timeline; }
    // JsonUtility reads fixed fields only, so each parameter of your actions needs a field here.
    [Serializable] public class Params { public string clip; public double speed; }
    [Serializable] public class Use { public string action; public int start_frame; public double duration_s;
        public Params @params; }

    [TextArea] public string manifest;    // JSON on one line, without contort and token; handed: "left".
    public List<Transform> joints;        // In the order of the manifest; the first one is the root.
    public Animator animator;

    StreamReader reader;
    NetworkStream stream;

    void Start()
    {
        animator.enabled = false;         // Update moves it by exactly one frame each time.
        var port = int.Parse(Environment.GetEnvironmentVariable("CONTORT_PORT"));
        stream = new TcpClient("127.0.0.1", port) { NoDelay = true }.GetStream();
        reader = new StreamReader(stream, new UTF8Encoding(false));
    }

    // One request in each frame of Unity.
    void Update()
    {
        var line = reader.ReadLine();
        if (line == null) { Application.Quit(); return; }
        var message = JsonUtility.FromJson<Message>(line);
        if (message.op == "hello") { Send(Hello(), new byte[0]); return; }
        try
        {
            var bytes = Generate(message);
            Send("{\"id\":" + message.id + ",\"bytes\":" + bytes.Length + "}", bytes);
        }
        catch (Exception error)
        {
            var text = error.Message.Replace('\\', ' ').Replace('"', '\'').Replace('\n', ' ').Replace('\r', ' ');
            Send("{\"id\":" + message.id + ",\"error\":\"failed\",\"text\":\"" + text + "\"}", new byte[0]);
        }
    }

    string Hello()
    {
        var token = Environment.GetEnvironmentVariable("CONTORT_TOKEN");
        return "{\"contort\":1,\"token\":\"" + token + "\"," + manifest.Trim().Substring(1);
    }

    byte[] Generate(Message message)
    {
        animator.Rebind();                // Each request begins afresh.
        var rows = new MemoryStream();
        var writer = new BinaryWriter(rows);
        var next = 0;
        for (var frame = 0; frame < message.frames; ++frame)
        {
            for (; next < message.timeline.Count && message.timeline[next].start_frame <= frame; ++next)
                Begin(message.timeline[next]);
            animator.Update(frame == 0 ? 0f : (float)(1.0 / message.rate_hz));
            WriteRow(writer);
        }
        return rows.ToArray();
    }

    // Carries out one use of an action. Add your own actions here.
    protected virtual void Begin(Use use)
    {
        if (use.action == "cross_fade") animator.CrossFadeInFixedTime(use.@params.clip, 0.5f);
        if (use.action == "play") animator.Play(use.@params.clip, 0, 0f);
        if (use.action == "speed") animator.speed = (float)use.@params.speed;
    }

    void WriteRow(BinaryWriter writer)
    {
        var at = joints[0].position;
        foreach (var value in new[] { at.x, at.y, at.z }) writer.Write((double)value);
        for (var i = 0; i < joints.Count; ++i)
        {
            var turned = i == 0 ? joints[i].rotation : joints[i].localRotation;
            foreach (var value in new[] { turned.x, turned.y, turned.z, turned.w }) writer.Write((double)value);
        }
    }

    void Send(string line, byte[] bytes)
    {
        var head = Encoding.UTF8.GetBytes(line + "\n");
        var reply = new byte[head.Length + bytes.Length];
        head.CopyTo(reply, 0);
        bytes.CopyTo(reply, head.Length);
        stream.Write(reply, 0, reply.Length);
    }
}
