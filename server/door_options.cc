#include "server/door_options.h"

#include <cstdio>

namespace lambert::server {

CLI::Option* AddDoorOptions(CLI::App& app, DoorOptions& doors) {
  app.add_option("--tls-cert", doors.tls_cert, "PEM file of the server's certificate: TLS only");
  app.add_option("--tls-key", doors.tls_key, "PEM file of that certificate's key");
  app.add_option("--tls-client-ca", doors.tls_client_ca,
                 "PEM file of who signs certificates of clients and workers");
  app.add_option("--tls-revoked", doors.tls_revoked,
                 "file of fingerprints of those certificates that are taken back");
  app.add_flag("--insecure", doors.insecure,
               "listen on any address, also where anybody may come or tokens can be read");
  return app.add_option("--tokens", doors.tokens, "file of who may come with which token");
}

void AddNewTokenOptions(CLI::App& app, CLI::Option* tokens, NewToken& wanted) {
  CLI::Option* new_token =
      app.add_option("--new-token", wanted.name,
                     "add a token of this name to the file of --tokens, print it, and end")
          ->needs(tokens);
  app.add_option("--role", wanted.role, "of the new token: client, worker, merger or admin")
      ->check(CLI::IsMember({"client", "worker", "merger", "admin"}))
      ->needs(new_token)
      ->capture_default_str();
}

void AddLimitOptions(CLI::App& app, CoordinatorOptions& options) {
  constexpr double kMost = 1e18;
  const auto add = [&app](const std::string& name, auto& limit, const std::string& help) {
    app.add_option(name, limit, help)
        ->check(CLI::Range(0., kMost))
        ->capture_default_str()
        ->group("Limits");
  };
  add("--max-scene-bytes", options.scene.bytes, "of all files of a scene");
  add("--max-triangles", options.scene.triangles, "of a scene, with instances");
  add("--max-instances", options.scene.instances, "of meshes in a scene");
  add("--max-total-pixels", options.scene.total_pixels, "of all images of a scene");
  add("--max-image-pixels", options.scene.image_pixels, "of one image of a scene");
  add("--max-patches", options.max_patches, "of a job");
  add("--client-jobs", options.quotas.jobs, "of a client, not ended; 0: no limit, here and below");
  add("--client-bytes", options.quotas.stored_bytes, "that a client has stored");
  add("--client-rays", options.quotas.rays_per_day, "of a client's jobs, a day (UTC)");
  add("--client-seconds", options.quotas.cpu_seconds_per_day,
      "of processors, of a client's jobs, a day (UTC)");
  add("--client-watchers", options.quotas.watchers, "that follow jobs for a client at once");
}

absl::Status PrintNewToken(const std::string& file, const NewToken& wanted) {
  Identity identity{wanted.name};
  ParseRole(wanted.role, &identity.role);
  absl::StatusOr<std::string> token = AddToken(file, identity);
  if (!token.ok()) return token.status();
  std::printf("%s\n", token->c_str());
  return absl::OkStatus();
}

}  // namespace lambert::server
