#!/usr/bin/env python3
"""A client in a second language, made from the .proto files alone: it uploads a scene, has it solved, watches,
and compares what it gets with the patches.csv of `lambert bake` in one process, number by number to the bit.

client_test.py PROTOC PROTO_FOLDER LAMBERT SERVER WORKER SCENE.glb; ends with 77 where Python has no gRPC.
"""

import csv
import hashlib
import importlib
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

try:
    import google
    import grpc
    from google.protobuf import descriptor_pb2
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

CHUNK_BYTES = 1 << 20
RAYS = 300_000
SEED = 5


class Protos:
    """Message classes of the package, and calls by name."""

    def __init__(self, protoc, folder, out):
        files = sorted(str(p.relative_to(folder)) for p in pathlib.Path(folder).rglob("*.proto"))
        subprocess.run([protoc, "-I", folder, f"--python_out={out}", *files], check=True)
        sys.path.insert(0, out)
        google.__path__.append(os.path.join(out, "google"))  # beside google.protobuf
        modules = [f[: -len(".proto")].replace("/", ".") + "_pb2" for f in files]
        self._modules = [importlib.import_module(m) for m in modules]

    def __getattr__(self, name):
        for module in self._modules:
            if hasattr(module, name):
                return getattr(module, name)
        raise AttributeError(name)

    def call(self, channel, service, method, request):
        """Makes a call as its .proto describes it; `request` is a message, or a list where they are streamed."""
        services = [m.DESCRIPTOR.services_by_name.get(service) for m in self._modules]
        found = next(s for s in services if s is not None)
        described = descriptor_pb2.MethodDescriptorProto()
        found.methods_by_name[method].CopyToProto(described)
        up, down = described.client_streaming, described.server_streaming
        stub = getattr(channel, f"{'stream' if up else 'unary'}_{'stream' if down else 'unary'}")(
            f"/{found.full_name}/{method}",
            request_serializer=lambda message: message.SerializeToString(),
            response_deserializer=getattr(self, described.output_type.split(".")[-1]).FromString,
        )
        return stub(iter(request) if up else request, timeout=120)


def start(command, pattern):
    """Starts a program and waits for a line of its log; the match's first group is what it says."""
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    for line in process.stderr:
        match = re.search(pattern, line)
        if match:
            return process, match.group(1)
    raise RuntimeError(f"{command[0]} ended with {process.wait()}")


def upload(pb, channel, data):
    digest = pb.Digest(sha256=hashlib.sha256(data).hexdigest(), size_bytes=len(data))
    missing = pb.call(
        channel, "BlobService", "FindMissingBlobs", pb.FindMissingBlobsRequest(digests=[digest])
    )
    if missing.missing_digests:
        pieces = [
            pb.UploadBlobRequest(digest=digest, offset_bytes=at, data=data[at : at + CHUNK_BYTES])
            for at in range(0, len(data), CHUNK_BYTES)
        ]
        done = pb.call(channel, "BlobService", "UploadBlob", pieces)
        assert done.committed_size_bytes == len(data)
    return digest


def download(pb, channel, digest):
    request = pb.DownloadBlobRequest(sha256=digest.sha256)
    data = b"".join(p.data for p in pb.call(channel, "BlobService", "DownloadBlob", request))
    assert len(data) == digest.size_bytes
    assert hashlib.sha256(data).hexdigest() == digest.sha256
    return data


def watch(pb, channel, job, last_version, stop_after=None):
    """Follows a job: (newest version, its bytes, the job as it ended). `stop_after` snapshots it hangs up."""
    request = pb.WatchSnapshotsRequest(
        parent=job, last_version=last_version, view=pb.SNAPSHOT_VIEW_FULL
    )
    stream = pb.call(channel, "SnapshotService", "WatchSnapshots", request)
    snapshot, payload, seen = None, b"", 0
    for news in stream:
        kind = news.WhichOneof("news")
        if kind == "snapshot":
            assert news.snapshot.version > last_version, "an old snapshot came again"
            snapshot, payload, last_version = news.snapshot, b"", news.snapshot.version
        elif kind == "payload_chunk":
            payload += news.payload_chunk
            if len(payload) == snapshot.payload_digest.size_bytes:
                assert hashlib.sha256(payload).hexdigest() == snapshot.payload_digest.sha256
                seen += 1
                if seen == stop_after:
                    stream.cancel()
                    break
        elif kind == "job_ended":
            return last_version, payload, news.job_ended
    return last_version, payload, None


def expect_reason(pb, channel, reason):
    """A call that must fail says why, for machines."""
    try:
        pb.call(channel, "SolveJobService", "GetSolveJob", pb.GetSolveJobRequest(name="solveJobs/no"))
    except grpc.RpcError as error:
        assert error.code() == grpc.StatusCode.NOT_FOUND, error
        details = dict(error.trailing_metadata())["grpc-status-details-bin"]
        info = pb.ErrorInfo()
        assert pb.Status.FromString(details).details[0].Unpack(info)
        assert (info.reason, info.domain) == (reason, "lambert"), info
        return
    raise AssertionError("the call did not fail")


def check_solution(payload, table_path):
    """The table's decimals read back to the very doubles of the solution (docs/formats.md)."""
    magic, count = struct.unpack_from("<4sI", payload)
    assert magic == b"LCS1", magic
    with open(table_path, newline="") as table:
        rows = list(csv.DictReader(table))
    assert len(rows) == count, (len(rows), count)
    at = 8 + 5 * 3 * 8  # after the ledger
    for column in ("radiosity", "irradiance", "std_error"):
        values = struct.unpack_from(f"<{3 * count}d", payload, at)
        at += 3 * count * 8
        wanted = [float(row[f"{column}_{channel}"]) for row in rows for channel in "rgb"]
        assert struct.pack(f"<{3 * count}d", *wanted) == struct.pack(f"<{3 * count}d", *values), column
    assert len(payload) == at + 8 * count
    return count


def main(protoc, proto_folder, lambert, server_program, worker_program, scene_path):
    running = []
    with tempfile.TemporaryDirectory() as folder:
        pb = Protos(protoc, proto_folder, folder)
        try:
            server, address = start([server_program, "--listen", "127.0.0.1:0"], r"listening on (\S+)")
            running.append(server)
            with grpc.insecure_channel(address) as channel:
                expect_reason(pb, channel, "JOB_NOT_FOUND")
                scene_bytes = pathlib.Path(scene_path).read_bytes()
                file = pb.SceneFile(uri="room.glb", digest=upload(pb, channel, scene_bytes))
                scene = pb.call(channel, "SceneService", "CreateScene", pb.CreateSceneRequest(files=[file]))
                spec = pb.SolveSpec(shoot=pb.ShootSpec(method="pmcr"), seed=SEED, max_ray_count=RAYS)
                request = pb.CreateSolveJobRequest(scene=scene.name, spec=spec, request_id="only-once")
                job = pb.call(channel, "SolveJobService", "CreateSolveJob", request)
                again = pb.call(channel, "SolveJobService", "CreateSolveJob", request)
                assert again.name == job.name, "a repeated request started a second job"

                worker, _ = start([worker_program, "--server", address], r"(at work)")
                running.append(worker)
                version, payload, ended = watch(pb, channel, job.name, 0, stop_after=1)
                if ended is None:  # hung up; goes on where it was
                    version, newer, ended = watch(pb, channel, job.name, version)
                    payload = newer or payload
                assert ended.state == pb.SolveJob.STATE_SUCCEEDED, ended
                assert payload == download(pb, channel, ended.latest_snapshot.payload_digest)
                assert download(pb, channel, ended.patch_set_digest)[:8] == b"LMBPTCH3"
        finally:
            for process in reversed(running):
                process.terminate()
                process.communicate()
        options = ["--method", "pmcr", "--seed", str(SEED), "--max-rays", str(RAYS)]
        bake = [lambert, "bake", scene_path, "-o", folder, *options, "--progress", "none"]
        subprocess.run(bake, check=True, stdout=subprocess.DEVNULL)
        count = check_solution(payload, os.path.join(folder, "patches.csv"))
        print(f"{count} patches, {3 * 3 * count} numbers: equal to lambert bake to the bit")


if __name__ == "__main__":
    main(*sys.argv[1:])
