# Lets Contort test a generator that runs in Godot 3. Extend this script, override `manifest` and `generate`, and run
# Godot with it: godot3-server -s my_generator.gd. Godot cannot read its standard input, so the script connects to the
# port in CONTORT_PORT. It answers one request in each idle step: more would overflow the message queue of the engine.
extends SceneTree

var connection = StreamPeerTCP.new()
var received = PoolByteArray()


# Override this. Returns the manifest as a dictionary; docs/reference/guests.md has all its fields.
func manifest():
	return {}


# Override this. Returns an array with one row for each frame of the request: the position of the root, then the
# quaternion x, y, z, w of each joint against its parent.
func generate(_request):
	return []


func _initialize():
	OS.low_processor_usage_mode_sleep_usec = 0
	if connection.connect_to_host("127.0.0.1", int(OS.get_environment("CONTORT_PORT"))) != OK:
		push_error("cannot connect to CONTORT_PORT")
		quit()


func _idle(_delta):
	var status = connection.get_status()
	if status == StreamPeerTCP.STATUS_CONNECTING:
		return
	if status != StreamPeerTCP.STATUS_CONNECTED:
		return quit()
	connection.set_no_delay(true)
	var got = connection.get_partial_data(1 << 16)
	if got[0] != OK:  # Contort has closed the connection.
		return quit()
	received.append_array(got[1])
	var line = read_line() if got[1].size() > 0 else ""
	if line != "":
		answer(JSON.parse(line).result)


func read_line():
	var end = Array(received).find(10)
	if end <= 0:
		return ""
	var line = received.subarray(0, end - 1).get_string_from_utf8()
	received = received.subarray(end + 1, received.size() - 1) if end + 1 < received.size() else PoolByteArray()
	return line


func answer(message):
	if message.op == "hello":
		var said = manifest()
		said["contort"] = 1
		said["token"] = OS.get_environment("CONTORT_TOKEN")
		send(said, PoolByteArray())
		return
	# A script error ends a function, not the engine; the function then returns null.
	var rows = generate(message)
	if rows == null:
		send({"id": int(message.id), "error": "failed", "text": "a script error; standard error has it"}, PoolByteArray())
		return
	var buffer = StreamPeerBuffer.new()
	for row in rows:
		for number in row:
			buffer.put_double(number)
	send({"id": int(message.id), "bytes": buffer.data_array.size()}, buffer.data_array)


func send(reply, bytes):
	var data = (JSON.print(reply) + "\n").to_utf8()
	data.append_array(bytes)
	connection.put_data(data)
